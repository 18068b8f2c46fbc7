// The summary of a lane.
#include <algorithm>

#include "core/batch/lane_group.h"
#include "core/encoder.h"
#include "core/simulation/metrics.h"

namespace hapticwall::batch {
namespace {

std::uint64_t count(double number) { return static_cast<std::uint64_t>(number); }

// Measuring is monotone, so the deepest measured position is that of the deepest position.
std::optional<double> max_penetration(const Scene& scene, const LaneEnd& end,
                                      const LaneAccount& account) {
  if (scene.x().walls.empty() || end.ticks == 0) return std::nullopt;
  double deepest_m =
      std::max(account.sums.maximum_m[end.lane], account.maximum_before_tail_m[end.lane]);
  const double encoder_m = scene.x().device.encoder_m.value_or(0.0);
  if (encoder_m > 0.0) deepest_m = quantise(deepest_m, encoder_m);
  return deepest_m - scene.x().walls.front().position_m;
}

RunStats run_stats(const Scene& scene, const LaneEnd& end, const LaneBlock& block) {
  const std::size_t lane = end.lane;
  const LaneAccount& a = block.state.account;
  RunStats stats;
  stats.contacts = count(a.sums.contacts[lane]);
  stats.saturated_ticks = count(block.state.motion.saturated_ticks[lane]);
  stats.max_penetration_m =
      max_penetration(scene, end, block.state.account).value_or(-RunStats::kInfinity);
  stats.peak_force_n = a.sums.peak_force_n[lane];
  stats.min_energy_cv_j = a.sums.min_cv_j[lane];
  stats.min_energy_scv_j = a.sums.min_scv_j[lane];
  stats.passivity_margin_j = a.sums.margin_j[lane];
  if (!end.has_tail) return stats;
  stats.tail_ticks = count(a.tail.ticks[lane]);
  stats.tail_min_m = a.tail.minimum_m[lane];
  stats.tail_max_m = a.sums.maximum_m[lane];
  stats.tail_force_mean_n = a.tail.mean_n[lane];
  stats.tail_force_square_n2 = a.tail.square_n2[lane];
  stats.tail_contact_force_n = a.tail.contact_force_n[lane];
  stats.tail_contact_penetration_m = a.tail.contact_penetration_m[lane];
  return stats;
}

PlantEnergies energies_of(std::size_t lane, const LaneBlock& block) {
  const LaneAccount& a = block.state.account;
  const double velocity = block.state.motion.velocity_m_per_s[lane];
  const double kinetic_j = block.parameters.half_mass_kg[lane] * (velocity * velocity);
  return plant_energies(a.sums.actuator_work_j[lane], a.sums.viscous_j[lane],
                        a.sums.hand_work_j[lane], kinetic_j);
}

}  // namespace

Summary lane_summary(const Scene& scene, const LaneEnd& end, const LaneBlock& block) {
  const LaneAccount& a = block.state.account;
  const EnergyLedger ledger{a.sums.cv_j[end.lane], a.sums.hold_j[end.lane], a.sums.scv_j[end.lane],
                            a.sums.budget_j[end.lane]};
  return summarise(scene, run_stats(scene, end, block), ledger, energies_of(end.lane, block),
                   {end.ticks, end.diverged_at_tick});
}

}  // namespace hapticwall::batch
