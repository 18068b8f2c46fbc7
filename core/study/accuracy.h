// Cost and error of every integrator and substep count on one scene, against a reference.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall {

// The positions of the reference are kept in memory, eight bytes a tick.
inline constexpr std::uint64_t kMaxAccuracyTicks = 10'000'000;

// Equal steps, nearly, on a logarithmic axis.
inline constexpr std::array kUsualSubsteps{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};

struct AccuracyOptions {
  // Substeps a tick of the integrators that take them, each from 1 to kMaxSubsteps.
  std::vector<int> substeps;
  // Monotonic clock in nanoseconds. Prefer the processor time of this thread to wall time, because
  // it excludes other programs.
  std::function<std::int64_t()> now_ns;
  // Called about every thousand ticks; true ends the study (Ctrl-C). May be empty.
  std::function<bool()> should_stop;
  // Receives the completed share of the work, 0 to 1. May be empty.
  std::function<void(double)> on_progress;
};

// One integrator and substep count. Fields that do not apply are nullopt: substeps of the exact
// integrator, and all errors if the run or the reference diverged.
struct AccuracyRow {
  Integrator integrator = Integrator::kExact;
  std::optional<int> substeps;
  std::optional<double> ns_per_tick;     // of the loop, without set-up; nullopt without a tick
  std::optional<double> ratio_to_exact;  // of ns_per_tick
  std::optional<double> set_up_ns;       // once a run, before the first tick
  std::optional<double> max_position_error_m;  // of the true position, over all ticks
  std::optional<double> energy_balance_error_j;
  std::optional<double> energy_balance_relative;
  std::optional<double> tail_peak_to_peak_m;
  // (this - reference) / reference; -1 if the oscillation is missing. nullopt if the reference
  // settled.
  std::optional<double> tail_peak_to_peak_relative_error;
  Verdict verdict = Verdict::kSettled;
  std::optional<std::uint64_t> diverged_at_tick;
  bool verdict_agrees = false;  // with the reference's verdict
};

struct AccuracyStudy {
  Summary reference;              // the exact propagator in extended precision
  std::vector<AccuracyRow> rows;  // exact, then integrator by integrator in the order of substeps
  bool stopped_early = false;     // the rows are then incomplete
};

// Measures a validated scene; ignores its integrator. One run per row gives the errors. The times
// are medians over several rounds of runs without samples, in which all rows take turns. Only the
// times differ from call to call.
// Throws std::invalid_argument if a pointer leads the hand, no clock is given, a substep count
// is out of range, or the scene has more than kMaxAccuracyTicks ticks. Realtime-safe: no.
[[nodiscard]] AccuracyStudy measure_accuracy(const Scene& scene, const AccuracyOptions& options);

}  // namespace hapticwall
