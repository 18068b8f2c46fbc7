#include "app/ui/computed/all_runs.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "core/run/simulate.h"

namespace hapticwall::ui {
namespace {

// The position over the last seconds of a run.
class TailTrace {
 public:
  explicit TailTrace(const Scene& scene) {
    const std::uint64_t all = scene.tick_count();
    const auto kept = static_cast<std::uint64_t>(kTraceS * scene.sampling.rate_hz);
    first_ = all > kept ? all - kept : 0;
    ticks_in_column_ = std::max<std::uint64_t>((all - first_) / kTraceColumns, 1);
  }
  void add(const Sample& sample) {
    if (sample.tick < first_) return;
    const double position_m = sample.truth.position_m;
    if ((sample.tick - first_) % ticks_in_column_ == 0) {
      lowest_ = highest_ = position_m;
      for (int end = 0; end < 2; ++end) {
        trace_.time_s.push_back(sample.time_s);
        trace_.value.push_back(position_m);
      }
    }
    lowest_ = std::min(lowest_, position_m);
    highest_ = std::max(highest_, position_m);
    *(trace_.value.end() - 2) = lowest_;
    trace_.value.back() = highest_;
  }
  [[nodiscard]] draw::Trace take() { return std::move(trace_); }

 private:
  std::uint64_t first_ = 0;
  std::uint64_t ticks_in_column_ = 1;
  double lowest_ = 0.0;
  double highest_ = 0.0;
  draw::Trace trace_;
};

// Every algorithm in all its forms, even if the scene names one of them.
std::vector<ComparedAlgorithm> all_of(const Scene& scene) {
  std::vector<ComparedAlgorithm> all;
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    AlgorithmSettings settings = scene.algorithm;
    if (const auto form = find_algorithm_parameter(algorithms()[i].forms_key))
      settings.values[*form].reset();
    std::ranges::copy(compared_algorithms(settings, std::array{i}), std::back_inserter(all));
  }
  return all;
}

bool same_but_for_the_algorithm(Scene a, const Scene& b) {
  a.algorithm.index = b.algorithm.index;
  return a == b;
}

}  // namespace

std::vector<AlgorithmRun> run_all(const Scene& scene,
                                  const std::function<bool(double fraction)>& goes_on) {
  const std::vector<ComparedAlgorithm> all = all_of(scene);
  std::vector<AlgorithmRun> runs;
  for (const ComparedAlgorithm& algorithm : all) {
    Scene one = scene;
    one.algorithm = algorithm.settings;
    TailTrace trace(one);
    SimulationOptions options;
    options.on_sample = [&](const Sample& sample) { trace.add(sample); };
    const double done = static_cast<double>(runs.size()) / static_cast<double>(all.size());
    options.should_stop = [&] { return goes_on && !goes_on(done); };
    SimulationResult result = simulate(one, options);
    if (result.stopped_early) return {};
    runs.push_back({algorithm, std::move(result.summary), trace.take()});
  }
  return runs;
}

AllRuns::AllRuns()
    : Computed(
          [](const Scene& scene, const Progress& progress, const Deliver& deliver) -> Result<bool> {
            std::vector<AlgorithmRun> runs = run_all(scene, progress);
            if (runs.empty()) return false;
            deliver(std::move(runs));
            return true;
          },
          same_but_for_the_algorithm) {}

}  // namespace hapticwall::ui
