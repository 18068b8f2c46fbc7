#include "core/run/metrics.h"

#include <cmath>

#include "core/algorithm/algorithm.h"

namespace hapticwall {
namespace {

void write_tail(const RunStats& stats, Summary& summary) {
  if (stats.tail_ticks == 0) return;
  summary.tail_peak_to_peak_m = stats.tail_max_m - stats.tail_min_m;
  summary.tail_force_mean_n = stats.tail_force_mean_n;
  summary.tail_force_std_n =
      std::sqrt(stats.tail_force_square_n2 / static_cast<double>(stats.tail_ticks));
  if (stats.tail_contact_penetration_m > 0.0) {
    // The quotient overflows at a denormal penetration; a summary is finite.
    constexpr double kMax = std::numeric_limits<double>::max();
    summary.displayed_stiffness_n_per_m =
        std::clamp(stats.tail_contact_force_n / stats.tail_contact_penetration_m, -kMax, kMax);
  }
}

Verdict verdict_of(const Summary& summary) {
  if (summary.diverged_at_tick) return Verdict::kDiverged;
  const bool still =
      summary.tail_peak_to_peak_m && *summary.tail_peak_to_peak_m <= kSettledPeakToPeakM;
  if (!still) return Verdict::kOscillating;
  return *summary.tail_force_std_n <= kSettledForceStdN ? Verdict::kSettled : Verdict::kBuzzing;
}

}  // namespace

std::uint64_t tail_begin_tick(std::uint64_t ticks, double rate_hz) {
  const auto tail_ticks = static_cast<std::uint64_t>(std::max(1.0, std::round(kTailS * rate_hz)));
  return ticks > tail_ticks ? ticks - tail_ticks : 0;
}

Summary summarise(const Scene& scene, const RunStats& stats, const EnergyLedger& ledger,
                  const std::optional<PlantEnergies>& energies, const RunEnd& end) {
  Summary summary;
  summary.scene = scene.name;
  summary.algorithm = algorithm_label(scene.algorithm);
  summary.ticks = end.ticks;
  summary.duration_s = static_cast<double>(end.ticks) / scene.sampling.rate_hz;
  summary.diverged_at_tick = end.diverged_at_tick;
  write_tail(stats, summary);
  summary.verdict = verdict_of(summary);
  if (stats.tail_ticks > 0 && summary.duration_s < kTailS) summary.verdict_note = kShortRun;
  if (stats.contacts > 0) summary.max_penetration_m = stats.max_penetration_m;
  summary.peak_force_n = stats.peak_force_n;
  summary.saturated_ticks = stats.saturated_ticks;
  summary.contacts = stats.contacts;
  summary.energy_cv_j = ledger.cv_j;
  summary.energy_hold_j = ledger.hold_j;
  summary.energy_scv_j = ledger.scv_j;
  summary.energy_budget_j = ledger.budget_j;
  summary.min_energy_cv_j = stats.min_energy_cv_j;
  summary.min_energy_scv_j = stats.min_energy_scv_j;
  if (energies) {
    summary.true_actuator_work_j = energies->actuator_work_j;
    summary.true_dissipation_j = energies->dissipation_j;
    summary.true_hand_work_j = energies->hand_work_j;
    summary.kinetic_j = energies->kinetic_j;
    summary.energy_balance_error_j = energies->balance_error_j;
    const double turned_j = turnover_j(energies->hand_work_j, energies->actuator_work_j,
                                       energies->dissipation_j, energies->kinetic_j);
    if (turned_j > 0.0) {
      summary.energy_balance_relative = std::abs(energies->balance_error_j) / turned_j;
    }
    summary.passivity_margin_j = stats.passivity_margin_j;
  }
  return summary;
}

Metrics::Metrics(const Scene& scene, std::uint64_t planned_ticks, bool has_truth)
    : scene_(scene),
      has_truth_(has_truth),
      ticks_(tail_begin_tick(planned_ticks, scene.sampling.rate_hz)) {}

void Metrics::add(const Sample& sample) {
  const double position_m = has_truth_ ? sample.truth.position_m : sample.position_m;
  if (end_.diverged_at_tick || has_diverged(position_m) || !std::isfinite(sample.force_n)) {
    if (!end_.diverged_at_tick) diverge(sample.tick);
    // A device was commanded, wherever its handle went.
    if (!has_truth_) ticks_.add_force(sample.force_n);
    return;
  }
  if (has_truth_) {
    if (!initial_kinetic_j_) initial_kinetic_j_ = sample.truth.kinetic_j;
    const PlantTruth& truth = sample.truth;
    ticks_.add_net_work(truth.actuator_work_j + truth.dissipation_j + truth.kinetic_j -
                        *initial_kinetic_j_);
  }
  ticks_.add(end_.ticks++,
             {position_m, sample.penetration_m, sample.force_n,
              (sample.flags & kFlagInContact) != 0, (sample.flags & kFlagForceLimit) != 0},
             ledger_of(sample));
  last_ = sample;
}

Summary Metrics::finish() const {
  std::optional<PlantEnergies> energies;
  if (initial_kinetic_j_) {
    const PlantTruth& truth = last_.truth;
    energies = plant_energies(truth.actuator_work_j, truth.dissipation_j, truth.hand_work_j,
                              truth.kinetic_j, *initial_kinetic_j_);
  }
  return summarise(scene_, ticks_.stats(), ledger_of(last_), energies, end_);
}

}  // namespace hapticwall
