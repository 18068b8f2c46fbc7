#include "core/study/accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "core/run/simulate.h"

namespace hapticwall {
namespace {

// Odd, for the median. A disturbance shorter than a round affects one measurement of a few rows,
// and the median removes it.
constexpr int kRounds = 7;
// Minimum time of a row in a round: a single run of a fast row is too short for the clock.
constexpr std::int64_t kMinTimedNs = 2'000'000;
constexpr int kMaxRepetitions = 1000;  // bound for a clock that stands still
// Approximate cost of the extended-precision run in exact runs, for the progress bar.
constexpr double kReferenceWork = 10.0;
constexpr double kTicksPerQuestion = 1024.0;  // approximate, for the progress bar

constexpr std::array kSteppedIntegrators{Integrator::kSemiImplicitEuler, Integrator::kRungeKutta4};

struct TimedRun {
  double set_up_ns = 0.0;
  double loop_ns = 0.0;
  std::uint64_t ticks = 0;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Candidate {
  Scene scene;
  AccuracyRow row;
  double work = 1.0;  // approximate cost of a run, in exact runs
  std::vector<double> ns_per_tick;
  std::vector<double> set_up_ns;
};

class Study {
 public:
  Study(const Scene& scene, const AccuracyOptions& options) : scene_(scene), options_(options) {
    add(Integrator::kExact, std::nullopt);
    for (const Integrator integrator : kSteppedIntegrators) {
      for (const int substeps : options.substeps) add(integrator, substeps);
    }
    total_work_ = kReferenceWork;
    for (const Candidate& candidate : candidates_) total_work_ += candidate.work * (1 + kRounds);
  }

  AccuracyStudy run() {
    AccuracyStudy study;
    study.reference = run_reference();
    for (Candidate& candidate : candidates_) {
      if (!stopped_) measure_errors(study.reference, candidate);
    }
    for (int round = 0; round < kRounds; ++round) {
      for (Candidate& candidate : candidates_) {
        if (!stopped_) measure_time(candidate);
      }
    }
    for (Candidate& candidate : candidates_) {
      finish(candidate);
      study.rows.push_back(candidate.row);
    }
    study.stopped_early = stopped_;
    return study;
  }

 private:
  void add(Integrator integrator, std::optional<int> substeps) {
    Candidate& candidate = candidates_.emplace_back();
    candidate.scene = scene_;
    candidate.scene.simulator = {integrator, substeps.value_or(1)};
    candidate.row.integrator = integrator;
    candidate.row.substeps = substeps;
    candidate.work = substeps.value_or(1);
  }

  Summary run_reference() {
    reference_position_m_.reserve(scene_.tick_count() + 1);
    SimulationOptions options = watched(kReferenceWork);
    options.on_sample = [&](const Sample& sample) {
      reference_position_m_.push_back(sample.truth.position_m);
    };
    const SimulationResult result = simulate_reference(scene_, options);
    reference_position_m_.push_back(result.final_state.truth.position_m);
    work_done_ += kReferenceWork;
    return result.summary;
  }

  void measure_errors(const Summary& reference, Candidate& candidate) {
    double largest_m = 0.0;
    const auto compare = [&](const Sample& sample) {
      if (sample.tick >= reference_position_m_.size()) return;  // the reference diverged earlier
      const double error_m = std::abs(sample.truth.position_m - reference_position_m_[sample.tick]);
      largest_m = std::max(largest_m, error_m);
    };
    SimulationOptions options = watched(candidate.work);
    options.on_sample = compare;
    const SimulationResult result = simulate(candidate.scene, options);
    work_done_ += candidate.work;
    AccuracyRow& row = candidate.row;
    row.verdict = result.summary.verdict;
    row.diverged_at_tick = result.summary.diverged_at_tick;
    row.verdict_agrees = row.verdict == reference.verdict;
    if (row.verdict == Verdict::kDiverged) return;
    row.energy_balance_error_j = result.summary.energy_balance_error_j;
    row.energy_balance_relative = result.summary.energy_balance_relative;
    row.tail_peak_to_peak_m = result.summary.tail_peak_to_peak_m;
    if (reference.verdict == Verdict::kDiverged) return;
    compare(result.final_state);
    row.max_position_error_m = largest_m;
    if (reference.verdict != Verdict::kOscillating || !row.tail_peak_to_peak_m) return;
    const double reference_m = *reference.tail_peak_to_peak_m;
    row.tail_peak_to_peak_relative_error = (*row.tail_peak_to_peak_m - reference_m) / reference_m;
  }

  void measure_time(Candidate& candidate) {
    TimedRun sum;
    int repetitions = 0;
    do {
      const TimedRun run = time_run(candidate);
      sum.loop_ns += run.loop_ns;
      sum.set_up_ns += run.set_up_ns;
      sum.ticks += run.ticks;
      ++repetitions;
    } while (!stopped_ && repetitions < kMaxRepetitions &&
             sum.loop_ns < static_cast<double>(kMinTimedNs));
    work_done_ += candidate.work;
    candidate.set_up_ns.push_back(sum.set_up_ns / repetitions);
    if (sum.ticks == 0) return;
    candidate.ns_per_tick.push_back(sum.loop_ns / static_cast<double>(sum.ticks));
  }

  // simulate() calls should_stop after the set-up and before the first tick: this call separates
  // the two times.
  TimedRun time_run(const Candidate& candidate) {
    SimulationOptions options = watched(candidate.work);
    const std::int64_t start_ns = options_.now_ns();
    std::optional<std::int64_t> loop_start_ns;
    options.should_stop = [&, ask = options.should_stop] {
      const bool stop = ask();
      if (!loop_start_ns) loop_start_ns = options_.now_ns();
      return stop;
    };
    const SimulationResult result = simulate(candidate.scene, options);
    const std::int64_t end_ns = options_.now_ns();
    const std::int64_t parted_ns = loop_start_ns.value_or(start_ns);
    return {static_cast<double>(parted_ns - start_ns), static_cast<double>(end_ns - parted_ns),
            result.summary.ticks};
  }

  void finish(Candidate& candidate) const {
    AccuracyRow& row = candidate.row;
    if (!candidate.set_up_ns.empty()) row.set_up_ns = median(candidate.set_up_ns);
    if (!candidate.ns_per_tick.empty()) row.ns_per_tick = median(candidate.ns_per_tick);
    const std::optional<double>& exact_ns = candidates_.front().row.ns_per_tick;
    if (row.ns_per_tick && exact_ns && *exact_ns > 0.0) {
      row.ratio_to_exact = *row.ns_per_tick / *exact_ns;
    }
  }

  // Options of a run that can be stopped and reports progress.
  SimulationOptions watched(double work) {
    SimulationOptions options;
    const double each = work * kTicksPerQuestion / static_cast<double>(scene_.tick_count());
    options.should_stop = [this, work, each, begun = 0.0]() mutable {
      if (options_.on_progress) {
        options_.on_progress((work_done_ + std::min(begun, work)) / total_work_);
      }
      begun += each;
      if (options_.should_stop && options_.should_stop()) stopped_ = true;
      return stopped_;
    };
    return options;
  }

  const Scene& scene_;
  const AccuracyOptions& options_;
  std::vector<Candidate> candidates_;  // exact first
  std::vector<double> reference_position_m_;
  double total_work_ = 0.0;
  double work_done_ = 0.0;
  bool stopped_ = false;
};

}  // namespace

AccuracyStudy measure_accuracy(const Scene& scene, const AccuracyOptions& options) {
  if (!options.now_ns) throw std::invalid_argument("times need a clock");
  for (const int substeps : options.substeps) {
    if (substeps < 1 || substeps > kMaxSubsteps) {
      throw std::invalid_argument("a substep count is out of range");
    }
  }
  if (scene.tick_count() > kMaxAccuracyTicks) {
    throw std::invalid_argument("the scene has more ticks than a study keeps");
  }
  return Study(scene, options).run();
}

}  // namespace hapticwall
