#include "core/batch/lane_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/encoder.h"
#include "core/metrics.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::batch {
namespace {

std::uint64_t count(double number) { return static_cast<std::uint64_t>(number); }

// The deepest penetration: measuring is monotone, so that it stands where the handle was deepest.
std::optional<double> max_penetration(const Scene& scene, const LaneEnd& end,
                                      const LaneReach& reach) {
  if (scene.walls.empty() || end.ticks == 0) return std::nullopt;
  double deepest_m = std::max(reach.maximum_m[end.lane], reach.maximum_before_tail_m[end.lane]);
  const double encoder_m = scene.device.encoder_m.value_or(0.0);
  if (encoder_m > 0.0) deepest_m = quantise(deepest_m, encoder_m);
  return deepest_m - scene.walls.front().position_m;
}

// core/metrics.cpp, TickMetrics::write().
BatchVerdict verdict(const Scene& scene, const LaneEnd& end, const LaneReach& reach) {
  BatchVerdict figures;
  figures.ticks = end.ticks;
  figures.diverged_at_tick = end.diverged_at_tick;
  if (end.has_tail) {
    figures.tail_peak_to_peak_m = reach.maximum_m[end.lane] - reach.minimum_m[end.lane];
  }
  const bool quiet = end.has_tail && *figures.tail_peak_to_peak_m <= kSettledPeakToPeakM;
  figures.verdict = quiet ? Verdict::kSettled : Verdict::kOscillating;
  if (end.diverged_at_tick) figures.verdict = Verdict::kDiverged;
  figures.max_penetration_m = max_penetration(scene, end, reach);
  return figures;
}

void write_tail(std::size_t lane, const LaneAccount& account, Summary& summary) {
  summary.tail_force_mean_n = account.tail_mean_n[lane];
  summary.tail_force_std_n = std::sqrt(account.tail_square_n2[lane] / account.tail_ticks[lane]);
  const double penetration_m = account.tail_contact_penetration_m[lane];
  if (penetration_m > 0.0) {
    constexpr double kMost = std::numeric_limits<double>::max();
    summary.displayed_stiffness_n_per_m =
        std::clamp(account.tail_contact_force_n[lane] / penetration_m, -kMost, kMost);
  }
}

// core/simulation_loop.h, summary().
void write_energies(std::size_t lane, const LaneBlock& block, Summary& summary) {
  const LaneAccount& a = block.state.account;
  summary.energy_cv_j = a.cv_j[lane];
  summary.energy_hold_j = a.hold_j[lane];
  summary.energy_scv_j = a.scv_j[lane];
  summary.energy_budget_j = a.budget_j[lane];
  summary.min_energy_cv_j = a.min_cv_j[lane];
  summary.min_energy_scv_j = a.min_scv_j[lane];
  const double velocity = block.state.motion.velocity_m_per_s[lane];
  const double kinetic_j = block.parameters.half_mass_kg[lane] * (velocity * velocity);
  summary.true_actuator_work_j = a.actuator_work_j[lane];
  summary.true_dissipation_j = a.viscous_j[lane];
  summary.true_hand_work_j = a.hand_work_j[lane];
  summary.kinetic_j = kinetic_j;
  summary.energy_balance_error_j =
      a.hand_work_j[lane] - (kinetic_j + a.viscous_j[lane] + a.actuator_work_j[lane]);
  summary.passivity_margin_j = a.margin_j[lane];
}

}  // namespace

template <>
BatchVerdict lane_figures(const Scene& scene, const LaneEnd& end, const LaneBlock& block) {
  return verdict(scene, end, block.state.reach);
}

template <>
Summary lane_figures(const Scene& scene, const LaneEnd& end, const LaneBlock& block) {
  const BatchVerdict judged = verdict(scene, end, block.state.reach);
  Summary summary;
  summary.scene = scene.name;
  summary.algorithm = algorithm_label(scene.algorithm);
  summary.verdict = judged.verdict;
  summary.ticks = judged.ticks;
  summary.duration_s = static_cast<double>(judged.ticks) / scene.sampling.rate_hz;
  summary.diverged_at_tick = judged.diverged_at_tick;
  summary.tail_peak_to_peak_m = judged.tail_peak_to_peak_m;
  summary.max_penetration_m = judged.max_penetration_m;
  summary.peak_force_n = block.state.account.peak_force_n[end.lane];
  summary.saturated_ticks = count(block.state.motion.saturated_ticks[end.lane]);
  summary.contacts = count(block.state.account.contacts[end.lane]);
  if (end.has_tail) write_tail(end.lane, block.state.account, summary);
  write_energies(end.lane, block, summary);
  return summary;
}

}  // namespace hapticwall::batch
