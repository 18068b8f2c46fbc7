// The metrics of a run, gathered tick by tick in constant memory, and the summary made of them.
//
// TickMetrics takes what every tick has; the headless loop pays for no more. Metrics feeds it from
// samples, so that live sessions, recordings and headless runs get the same verdict.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/plant/moving_plant.h"
#include "core/run/touch_metrics.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"
#include "core/tick/energy_ledger.h"

namespace hapticwall {

// Limits of the verdict (docs/verdicts.md). A handle rests below the first, on a device with √2
// counts of its encoder added. A force above the second chatters, or above the third share of the
// device's force limit, if that is less: 0.3 N is above the dither of a passive algorithm by one
// count on the paper's device, ½ (2b/T) Δ = 0.25 N. A wall that gives more than the last power
// while it is touched is active.
inline constexpr double kSettledPeakToPeakM = 1e-4;
inline constexpr double kMaxChatterN = 0.3;
inline constexpr double kMaxChatterShare = 0.1;
inline constexpr double kMaxGivenW = 5e-3;
// The tail of a run is its last second.
inline constexpr double kTailS = 1.0;
inline constexpr const char* kShortRun = "the run is shorter than the tail of 1 s";
inline constexpr const char* kShortTouches =
    "no touch of the judged time is long enough (0.25 s) to judge chatter";

// One tick's contribution.
struct TickStats {
  double position_m = 0.0;        // true where it is known, else as measured
  double velocity_m_per_s = 0.0;  // true; 0 if unknown
  double absorbed_j = 0.0;        // see TouchTick
  double penetration_m = 0.0;
  double force_n = 0.0;
  bool in_contact = false;
  bool saturated = false;
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Positions of a stretch of ticks.
struct Way {
  double first_m = 0.0;
  double last_m = 0.0;
  double min_m = kInfinity;
  double max_m = -kInfinity;

  void add(double position_m) {
    if (!(max_m >= min_m)) first_m = position_m;
    last_m = position_m;
    min_m = std::min(min_m, position_m);
    max_m = std::max(max_m, position_m);
  }
  [[nodiscard]] double peak_to_peak_m() const { return max_m - min_m; }
};

// Sums and extremes of a run's ticks. Infinite extremes are neutral: nothing was added yet.
struct RunStats {
  std::uint64_t contacts = 0;
  std::uint64_t saturated_ticks = 0;
  double max_penetration_m = -kInfinity;
  double peak_force_n = 0.0;
  double min_energy_cv_j = 0.0;
  double min_energy_scv_j = 0.0;
  double passivity_margin_j = 0.0;  // minimum over time of the hand's net work

  std::uint64_t tail_ticks = 0;
  Way tail_way;
  Way tail_end_way;  // of the last half second
  double tail_force_mean_n = 0.0;
  double tail_force_square_n2 = 0.0;  // Σ (force - mean)²
  double tail_contact_force_n = 0.0;  // sums over the tail's ticks in contact
  double tail_contact_penetration_m = 0.0;

  TouchStats touch;
};

// Realtime-safe: yes.
class TickMetrics {
 public:
  // `tail_begin_tick`: the first tick of the tail. `judged_from_tick`: pieces that begin earlier
  // are not judged.
  TickMetrics(double rate_hz, std::uint64_t tail_begin_tick, std::uint64_t judged_from_tick)
      : tail_begin_tick_(tail_begin_tick),
        half_tail_ticks_(static_cast<std::uint64_t>(0.5 * kTailS * rate_hz)),
        touch_(rate_hz, judged_from_tick, tail_begin_tick) {}

  // Call for every tick, in order, with the ledger after it.
  void add(std::uint64_t tick, const TickStats& stats, const EnergyLedger& ledger) {
    // Well-predicted branches beat selects here.
    if (stats.in_contact != was_in_contact_) [[unlikely]] {
      run_.contacts += stats.in_contact ? 1U : 0U;
      was_in_contact_ = stats.in_contact;
    }
    run_.saturated_ticks += stats.saturated ? 1U : 0U;
    keep_max(run_.max_penetration_m, stats.penetration_m);
    keep_max(run_.peak_force_n, std::abs(stats.force_n));
    keep_min(run_.min_energy_cv_j, ledger.cv_j);
    keep_min(run_.min_energy_scv_j, ledger.scv_j);
    touch_.add(tick, {stats.position_m, stats.force_n, stats.velocity_m_per_s, stats.absorbed_j,
                      stats.in_contact});
    if (tick >= tail_begin_tick_) add_to_tail(stats);
  }

  // A commanded force after the handle has left: only its peak counts.
  void add_force(double force_n) {
    if (std::isfinite(force_n)) keep_max(run_.peak_force_n, std::abs(force_n));
  }

  // The energy that the hand has put in so far, by the plant's own account.
  void add_net_work(double net_work_j) { keep_min(run_.passivity_margin_j, net_work_j); }

  [[nodiscard]] RunStats stats() const {
    RunStats stats = run_;
    stats.touch = touch_.stats();
    return stats;
  }

 private:
  static void keep_max(double& max, double value) { max = std::max(max, value); }
  static void keep_min(double& min, double value) { min = std::min(min, value); }
  void add_to_tail(const TickStats& stats) {
    run_.tail_way.add(stats.position_m);
    if (run_.tail_ticks >= half_tail_ticks_) run_.tail_end_way.add(stats.position_m);
    ++run_.tail_ticks;
    // Welford: no cancellation, whatever the mean.
    const double difference_n = stats.force_n - run_.tail_force_mean_n;
    run_.tail_force_mean_n += difference_n / static_cast<double>(run_.tail_ticks);
    run_.tail_force_square_n2 += difference_n * (stats.force_n - run_.tail_force_mean_n);
    if (stats.in_contact) {
      run_.tail_contact_force_n += stats.force_n;
      run_.tail_contact_penetration_m += stats.penetration_m;
    }
  }

  std::uint64_t tail_begin_tick_;
  std::uint64_t half_tail_ticks_;
  bool was_in_contact_ = false;
  TouchMetrics touch_;
  RunStats run_;
};

// A simulated plant's energies at the end of a run, sums since its start. The balance error is the
// hand's work less kinetic change, dissipation and actuator work.
struct PlantEnergies {
  double actuator_work_j = 0.0;
  double dissipation_j = 0.0;
  double hand_work_j = 0.0;
  double kinetic_j = 0.0;
  double balance_error_j = 0.0;
};

// Real: the plant's own precision. The balance is a small difference of large sums, so it is taken
// before the rounding to double.
template <typename Real>
[[nodiscard]] PlantEnergies plant_energies(Real actuator_work_j, Real dissipation_j,
                                           Real hand_work_j, Real kinetic_j,
                                           Real initial_kinetic_j = 0) {
  const Real error_j =
      hand_work_j - (kinetic_j - initial_kinetic_j + dissipation_j + actuator_work_j);
  return {static_cast<double>(actuator_work_j), static_cast<double>(dissipation_j),
          static_cast<double>(hand_work_j), static_cast<double>(kinetic_j),
          static_cast<double>(error_j)};
}

// How far a run came, and what is known of its motion.
struct RunEnd {
  std::uint64_t ticks = 0;
  std::optional<std::uint64_t> diverged_at_tick;
  bool hand_rests = false;  // the hand's intended path is known and constant in the tail
  bool has_truth = true;    // false: positions are those of an encoder
};

// The only place that fills a Summary. `ledger`: after the last tick. `energies`: of a simulator,
// else nullopt.
[[nodiscard]] Summary summarise(const Scene& scene, const RunStats& stats,
                                const EnergyLedger& ledger,
                                const std::optional<PlantEnergies>& energies, const RunEnd& end);

// True if the hand's path is known and constant from tick `from` to tick `end` - 1, as without a
// hand. Later motion does not count. Realtime-safe: yes.
[[nodiscard]] bool hand_rests(const Scene& scene, std::uint64_t from, std::uint64_t end);

// Metrics of a headless run of the scene.
[[nodiscard]] TickMetrics tick_metrics(const Scene& scene);

// First tick of the tail of a run of `ticks` ticks; 0 if the run is shorter than the tail.
[[nodiscard]] std::uint64_t tail_begin_tick(std::uint64_t ticks, double rate_hz);

// True if the position is not finite, or beyond ±1 m. Realtime-safe: yes.
[[nodiscard]] inline bool has_diverged(double position_m) {
  return !(std::abs(position_m) <= kDivergedPositionM);
}

// Energy that a device has taken from the hand, from its measured positions and the force that it
// reports as applied.
class AppliedEnergy {
 public:
  // Call for every tick, in order; `budget_j`: EnergyLedger::budget_j. Realtime-safe: yes.
  double absorbed_j(double position_m, double applied_force_n, double budget_j) {
    work_j_ += last_force_n_ * (position_m - last_position_m_);
    last_position_m_ = position_m;
    last_force_n_ = applied_force_n;
    return work_j_ - budget_j;
  }

 private:
  double work_j_ = 0.0;
  double last_force_n_ = 0.0;  // 0 before the first tick
  double last_position_m_ = 0.0;
};

// Origin of samples: a simulator, or a device, which may report the force that it applies.
enum class SampleOrigin : std::uint8_t { kSimulator, kDevice, kDeviceWithForce };

// The summary of a series of samples (a live session, a recording).
class Metrics {
 public:
  // `planned_ticks`: the number of samples to come; the tail is their last second. Of a simulator's
  // samples the true positions and energies count. Realtime-safe: no.
  Metrics(const Scene& scene, std::uint64_t planned_ticks, SampleOrigin origin);

  // Ignores samples after a diverged one. Realtime-safe: yes.
  void add(const Sample& sample);
  // The run diverged at this tick, before the tick had a sample.
  void diverge(std::uint64_t tick) { end_.diverged_at_tick = tick; }

  // Summary of the run. For a simulator's samples the energies are those at the last sample's
  // instant.
  [[nodiscard]] Summary finish() const;

 private:
  // Energy that the device has taken from the hand up to this sample, as its encoder sees it.
  [[nodiscard]] double absorbed_by_device_j(const Sample& sample);

  const Scene scene_;
  SampleOrigin origin_;
  std::uint64_t tail_begin_tick_;
  TickMetrics ticks_;
  std::optional<double> tail_path_m_;  // of the hand, at the begin of the tail
  bool hand_rests_ = false;
  AppliedEnergy applied_;
  RunEnd end_;
  std::optional<double> initial_kinetic_j_;
  Sample last_;
};

}  // namespace hapticwall
