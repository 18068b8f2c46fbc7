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
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"
#include "core/tick/energy_ledger.h"

namespace hapticwall {

// `settled` is a tail whose peak-to-peak and standard deviation of the force are at or below these;
// in a `buzzing` tail the position rests and the force does not. 0.3 N is above the dither of a
// passive algorithm by one count on the paper's device, ½ (2b/T) Δ = 0.25 N.
inline constexpr double kSettledPeakToPeakM = 1e-4;
inline constexpr double kSettledForceStdN = 0.3;
// The tail of a run is its last second.
inline constexpr double kTailS = 1.0;
inline constexpr const char* kShortRun = "the run is shorter than the tail of 1 s";

// One tick's contribution.
struct TickStats {
  double position_m = 0.0;  // true where it is known, else as measured
  double penetration_m = 0.0;
  double force_n = 0.0;
  bool in_contact = false;
  bool saturated = false;
};

// Sums and extremes of a run's ticks. Infinite extremes are neutral: nothing was added yet.
struct RunStats {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  std::uint64_t contacts = 0;
  std::uint64_t saturated_ticks = 0;
  double max_penetration_m = -kInfinity;
  double peak_force_n = 0.0;
  double min_energy_cv_j = 0.0;
  double min_energy_scv_j = 0.0;
  double passivity_margin_j = 0.0;  // minimum over time of the hand's net work

  std::uint64_t tail_ticks = 0;
  double tail_min_m = kInfinity;
  double tail_max_m = -kInfinity;
  double tail_force_mean_n = 0.0;
  double tail_force_square_n2 = 0.0;  // Σ (force - mean)²
  double tail_contact_force_n = 0.0;  // sums over the tail's ticks in contact
  double tail_contact_penetration_m = 0.0;
};

// Realtime-safe: yes.
class TickMetrics {
 public:
  // `tail_begin_tick`: the first tick of the tail.
  explicit TickMetrics(std::uint64_t tail_begin_tick) : tail_begin_tick_(tail_begin_tick) {}

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
    if (tick >= tail_begin_tick_) add_to_tail(stats);
  }

  // A commanded force after the handle has left: only its peak counts.
  void add_force(double force_n) {
    if (std::isfinite(force_n)) keep_max(run_.peak_force_n, std::abs(force_n));
  }

  // The energy that the hand has put in so far, by the plant's own account.
  void add_net_work(double net_work_j) { keep_min(run_.passivity_margin_j, net_work_j); }

  [[nodiscard]] const RunStats& stats() const { return run_; }

 private:
  static void keep_max(double& max, double value) { max = std::max(max, value); }
  static void keep_min(double& min, double value) { min = std::min(min, value); }
  void add_to_tail(const TickStats& stats) {
    run_.tail_min_m = std::min(run_.tail_min_m, stats.position_m);
    run_.tail_max_m = std::max(run_.tail_max_m, stats.position_m);
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
  bool was_in_contact_ = false;
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

// How far a run came.
struct RunEnd {
  std::uint64_t ticks = 0;
  std::optional<std::uint64_t> diverged_at_tick;
};

// The only place that fills a Summary. `ledger`: after the last tick. `energies`: of a simulator,
// else nullopt.
[[nodiscard]] Summary summarise(const Scene& scene, const RunStats& stats,
                                const EnergyLedger& ledger,
                                const std::optional<PlantEnergies>& energies, const RunEnd& end);

// First tick of the tail of a run of `ticks` ticks; 0 if the run is shorter than the tail.
[[nodiscard]] std::uint64_t tail_begin_tick(std::uint64_t ticks, double rate_hz);

// True if the position is not finite, or beyond ±1 m. Realtime-safe: yes.
[[nodiscard]] inline bool has_diverged(double position_m) {
  return !(std::abs(position_m) <= kDivergedPositionM);
}

// The summary of a series of samples (a live session, a recording).
class Metrics {
 public:
  // `planned_ticks`: the number of samples to come; the tail is their last second. `has_truth`: the
  // samples are a simulator's, whose true positions and energies count. Realtime-safe: no.
  Metrics(const Scene& scene, std::uint64_t planned_ticks, bool has_truth);

  // Ignores samples after a diverged one. Realtime-safe: yes.
  void add(const Sample& sample);
  // The run diverged at this tick, before the tick had a sample.
  void diverge(std::uint64_t tick) { end_.diverged_at_tick = tick; }

  // Summary of the run. For a simulator's samples the energies are those at the last sample's
  // instant.
  [[nodiscard]] Summary finish() const;

 private:
  const Scene scene_;
  bool has_truth_;
  TickMetrics ticks_;
  RunEnd end_;
  std::optional<double> initial_kinetic_j_;
  Sample last_;
};

}  // namespace hapticwall
