// What a tick of the headless loop costs, each row beside the bare loop of the same run.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/scene_file.h"
#include "core/simulate.h"
#include "core/stabiliser/stabiliser.h"
#include "tests/benchmark/bare_loop.h"

namespace hapticwall {
namespace {

Scene builtin(const char* name) {
  const auto loaded = file::load_scene(name);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
    std::exit(EXIT_FAILURE);
  }
  return loaded->scene;
}

constexpr const char* kBareLoop = "bare loop, golden-soft";
constexpr const char* kTicksCounter = "ticks";
constexpr const char* kSetUpSuffix = " (set-up)";

void count_ticks(benchmark::State& state, const Scene& scene) {
  state.counters[kTicksCounter] = static_cast<double>(scene.tick_count());
}

void bare_loop(benchmark::State& state) {
  const Scene scene = builtin("golden-soft");
  const benchmark_loops::BareLoop loop(scene);
  // The peer must do the same work: it ends where the program's own loop ends.
  const double end_m = simulate(scene).final_state.truth.position_m;
  if (std::abs(loop.run().position_m - end_m) > 1e-12) {
    state.SkipWithError("the bare loop does not follow golden-soft");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(loop.run());
  count_ticks(state, scene);
}

void run_scene(benchmark::State& state, const Scene& scene) {
  for (auto _ : state) benchmark::DoNotOptimize(simulate(scene));
  count_ticks(state, scene);
}

void with_samples(benchmark::State& state, const Scene& scene) {
  std::vector<Sample> samples(scene.tick_count());
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) { samples[sample.tick] = sample; };
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulate(scene, options));
    benchmark::ClobberMemory();
  }
  count_ticks(state, scene);
}

Scene with_encoder(Scene scene) {
  scene.device.encoder_m = 0.254e-3;
  return scene;
}

Scene under(std::string_view algorithm, Scene scene) {
  scene.algorithm.index = find_algorithm(algorithm).value();
  return scene;
}

// The same scene for one tick: what is paid before the loop begins.
void set_up(benchmark::State& state, Scene scene) {
  scene.duration_s = scene.sampling.period_s();
  for (auto _ : state) benchmark::DoNotOptimize(simulate(scene));
  count_ticks(state, scene);
}

void add_scene(const std::string& name, const Scene& scene) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [scene](benchmark::State& state) { run_scene(state, scene); });
  benchmark::RegisterBenchmark((name + kSetUpSuffix).c_str(),
                               [scene](benchmark::State& state) { set_up(state, scene); });
}

void register_all() {
  benchmark::RegisterBenchmark(kBareLoop, bare_loop);
  const Scene soft = builtin("golden-soft");
  add_scene("golden-soft, full ledger", soft);
  add_scene("golden-soft, encoder, full ledger", with_encoder(soft));
  benchmark::RegisterBenchmark("golden-soft, full ledger, every sample kept",
                               [soft](benchmark::State& state) { with_samples(state, soft); });
  add_scene("golden-soft-fric, full ledger", builtin("golden-soft-fric"));
  for (const AlgorithmDescription& algorithm : algorithms()) {
    add_scene("press, " + std::string(algorithm.name), under(algorithm.name, builtin("press")));
  }
}

// Google Benchmark has renamed this.
template <typename Run>
bool went_wrong(const Run& run) {
  if constexpr (requires { run.error_occurred; }) {
    return run.error_occurred;
  } else {
    return run.skipped != decltype(run.skipped){};
  }
}

// Collects the medians and says what they mean: nanoseconds a tick, and the ratio to the bare loop
// of the same run, with and without the set-up of a scene.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (went_wrong(run)) failed_ = true;
      const bool median = run.run_type == Run::RT_Aggregate && run.aggregate_name == "median";
      if (!median && run.repetitions > 1) continue;
      const auto ticks = run.counters.find(kTicksCounter);
      if (ticks == run.counters.end()) continue;
      // Processor time: a shared machine does not count against a row.
      const double total_ns = run.GetAdjustedCPUTime();
      rows_.push_back({run.run_name.function_name, run.family_index, total_ns, ticks->second});
    }
  }

  void Finalize() override {
    // Repetitions are interleaved at random; the table is not.
    std::sort(rows_.begin(), rows_.end(),
              [](const Row& a, const Row& b) { return a.family < b.family; });
    const Row* bare = find(kBareLoop);
    if (bare == nullptr) return;
    const double bare_ns = bare->total_ns / bare->ticks;
    std::printf("%-44s %12s %12s %14s\n", "", "ns per tick", "ratio", "without set-up");
    for (const Row& row : rows_) {
      if (row.name.ends_with(kSetUpSuffix)) continue;
      const double tick_ns = row.total_ns / row.ticks;
      std::printf("%-44s %12.1f %11.2fx", row.name.c_str(), tick_ns, tick_ns / bare_ns);
      if (const Row* before = find(row.name + kSetUpSuffix)) {
        const double loop_ns = (row.total_ns - before->total_ns) / (row.ticks - before->ticks);
        std::printf(" %13.2fx", loop_ns / bare_ns);
      }
      std::printf("\n");
    }
    if (const Row* before = find(std::string("golden-soft, full ledger") + kSetUpSuffix)) {
      std::printf("set-up of golden-soft: %.0f ns\n", before->total_ns);
    }
  }

  [[nodiscard]] bool failed() const { return failed_; }

 private:
  struct Row {
    std::string name;
    std::int64_t family;
    double total_ns;
    double ticks;
  };

  [[nodiscard]] const Row* find(const std::string& name) const {
    const auto found =
        std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.name == name; });
    return found == rows_.end() ? nullptr : &*found;
  }

  std::vector<Row> rows_;
  bool failed_ = false;
};

}  // namespace
}  // namespace hapticwall

int main(int argc, char** argv) {
  hapticwall::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  hapticwall::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  return reporter.failed() ? EXIT_FAILURE : EXIT_SUCCESS;
}
