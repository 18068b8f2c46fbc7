// The summary of a run, gathered tick by tick in constant memory.
//
// Two layers: TickMetrics takes what every tick has and is what the headless loop pays for; Metrics
// feeds it from recorded samples, so that a live session and a headless run are judged alike.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/energy_ledger.h"
#include "core/plant/moving_plant.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall {

// Tail peak-to-peak at or below this is `settled`.
inline constexpr double kSettledPeakToPeakM = 1e-4;
// The tail of a run is its last second.
inline constexpr double kTailS = 1.0;

// What one tick contributes.
struct TickFigures {
  double position_m = 0.0;  // true where it is known, else as measured
  double penetration_m = 0.0;
  double force_n = 0.0;
  bool in_contact = false;
  bool saturated = false;
};

// Realtime-safe: yes.
class TickMetrics {
 public:
  // `tail_begin_tick`: the first tick of the tail.
  explicit TickMetrics(std::uint64_t tail_begin_tick) : tail_begin_tick_(tail_begin_tick) {}

  void add(std::uint64_t tick, const TickFigures& figures, const EnergyLedger& ledger) {
    // Branches that hardly ever go the rare way are cheaper here than selections that always
    // happen.
    if (figures.in_contact != was_in_contact_) [[unlikely]] {
      contacts_ += figures.in_contact ? 1U : 0U;
      was_in_contact_ = figures.in_contact;
    }
    saturated_ticks_ += figures.saturated ? 1U : 0U;
    keep_maximum(max_penetration_m_, figures.penetration_m);
    keep_maximum(peak_force_n_, std::abs(figures.force_n));
    keep_minimum(min_energy_cv_j_, ledger.cv_j);
    keep_minimum(min_energy_scv_j_, ledger.scv_j);
    if (tick >= tail_begin_tick_) add_to_tail(figures);
  }

  // Energy that the hand has put in so far, by the plant's own account; its minimum is the
  // passivity margin.
  void add_net_work(double net_work_j) { keep_minimum(margin_j_, net_work_j); }

  // Fills verdict and figures of `summary`; the ledger's end values are the caller's.
  void write(Summary& summary, bool has_wall) const;
  [[nodiscard]] double passivity_margin_j() const { return margin_j_; }

 private:
  static void keep_maximum(double& maximum, double value) { maximum = std::max(maximum, value); }
  static void keep_minimum(double& minimum, double value) { minimum = std::min(minimum, value); }
  void add_to_tail(const TickFigures& figures) {
    tail_minimum_m_ = std::min(tail_minimum_m_, figures.position_m);
    tail_maximum_m_ = std::max(tail_maximum_m_, figures.position_m);
    ++tail_ticks_;
    // Welford: no cancellation, whatever the mean.
    const double difference_n = figures.force_n - tail_mean_n_;
    tail_mean_n_ += difference_n / static_cast<double>(tail_ticks_);
    tail_square_n2_ += difference_n * (figures.force_n - tail_mean_n_);
    if (figures.in_contact) {
      ++tail_contact_ticks_;
      contact_force_n_ += figures.force_n;
      contact_penetration_m_ += figures.penetration_m;
    }
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  std::uint64_t tail_begin_tick_;
  bool was_in_contact_ = false;
  std::uint64_t contacts_ = 0;
  std::uint64_t saturated_ticks_ = 0;
  double max_penetration_m_ = -kInfinity;
  double peak_force_n_ = 0.0;
  double min_energy_cv_j_ = 0.0;
  double min_energy_scv_j_ = 0.0;
  double margin_j_ = 0.0;

  std::uint64_t tail_ticks_ = 0;
  double tail_minimum_m_ = kInfinity;
  double tail_maximum_m_ = -kInfinity;
  double tail_mean_n_ = 0.0;
  double tail_square_n2_ = 0.0;
  std::uint64_t tail_contact_ticks_ = 0;
  double contact_force_n_ = 0.0;
  double contact_penetration_m_ = 0.0;
};

// First tick of the tail of a run of `ticks` ticks.
[[nodiscard]] std::uint64_t tail_begin_tick(std::uint64_t ticks, double rate_hz);

// True where the run has left what a scene can mean: not finite, or beyond ±1 m. Realtime-safe:
// yes.
[[nodiscard]] inline bool has_diverged(double position_m) {
  return !(std::abs(position_m) <= kDivergedPositionM);
}

// The summary of a series of samples (a live session, a recording).
class Metrics {
 public:
  // `planned_ticks`: how many samples will come; the tail is the last second of these.
  Metrics(const Scene& scene, std::uint64_t planned_ticks, bool has_truth);

  // Realtime-safe: yes.
  void add(const Sample& sample);

  // The figures so far. With a simulator's samples the energies are those of the last sample's
  // instant.
  [[nodiscard]] Summary finish() const;

 private:
  const Scene scene_;
  bool has_truth_;
  TickMetrics ticks_;
  std::uint64_t count_ = 0;
  std::optional<std::uint64_t> diverged_at_tick_;
  std::optional<double> initial_kinetic_j_;
  Sample last_;
};

}  // namespace hapticwall
