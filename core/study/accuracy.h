// Speed against accuracy on one scene: every integrator and substep count beside a reference, with
// what a tick costs and how far the motion, the energies and the verdict are off.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall {

// The reference's positions are kept in memory, eight bytes a tick; a scene may have this many.
inline constexpr std::uint64_t kMostAccuracyTicks = 10'000'000;

struct AccuracyOptions {
  // Substeps a tick of the integrators that take them, each from 1 to kMaximumSubsteps.
  std::vector<int> substeps;
  // Nanoseconds since a fixed instant, never going back: the core has no clock of its own. The time
  // that this thread has had the processor is better than the time of day: other programs do not
  // count.
  std::function<std::int64_t()> now_ns;
  // Asked about every thousand ticks; true ends the study (Ctrl-C). May be empty.
  std::function<bool()> should_stop;
  // Told the share of the work that is done, 0 to 1. May be empty.
  std::function<void(double)> on_progress;
};

// One integrator and substep count. Absent is what does not apply: substeps of the exact
// integrator, and every error of a run that diverged or whose reference did.
struct AccuracyRow {
  Integrator integrator = Integrator::kExact;
  std::optional<int> substeps;
  std::optional<double> ns_per_tick;     // of the loop, without the set-up; absent without a tick
  std::optional<double> ratio_to_exact;  // of ns_per_tick
  std::optional<double> set_up_ns;       // once a run, before the first tick
  std::optional<double> max_position_error_m;  // over all ticks, of the true position
  std::optional<double> energy_balance_error_j;
  std::optional<double> tail_peak_to_peak_m;
  // (this - reference) / reference; -1 where the oscillation vanishes. Absent where the reference
  // has settled: there is no oscillation to be off.
  std::optional<double> tail_peak_to_peak_relative_error;
  Verdict verdict = Verdict::kSettled;
  std::optional<std::uint64_t> diverged_at_tick;
  bool verdict_agrees = false;  // with the reference's
};

struct AccuracyStudy {
  Summary reference;              // the exact propagator in extended precision
  std::vector<AccuracyRow> rows;  // exact, then integrator by integrator in the order of substeps
  bool stopped_early = false;     // the rows are then not whole
};

// Measures a validated scene whatever integrator it names. The errors come from one run each; the
// times from further runs without samples, all rows in turn, several rounds, the median of which is
// told. Only the times differ from call to call.
// Throws std::invalid_argument where a pointer leads the hand, no clock is given, a substep count
// is out of range, or the scene has more than kMostAccuracyTicks ticks. Realtime-safe: no.
[[nodiscard]] AccuracyStudy measure_accuracy(const Scene& scene, const AccuracyOptions& options);

}  // namespace hapticwall
