#include "core/metrics.h"

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

std::uint64_t tail_begin_tick(std::uint64_t ticks, double rate_hz) {
  const auto tail_ticks = static_cast<std::uint64_t>(std::max(1.0, std::round(kTailS * rate_hz)));
  return ticks > tail_ticks ? ticks - tail_ticks : 0;
}

void TickMetrics::write(Summary& summary, bool has_wall) const {
  if (tail_ticks_ > 0) {
    summary.tail_peak_to_peak_m = tail_maximum_m_ - tail_minimum_m_;
    summary.tail_force_mean_n = tail_mean_n_;
    summary.tail_force_std_n = std::sqrt(tail_square_n2_ / static_cast<double>(tail_ticks_));
  }
  const bool quiet = tail_ticks_ > 0 && *summary.tail_peak_to_peak_m <= kSettledPeakToPeakM;
  summary.verdict = quiet ? Verdict::kSettled : Verdict::kOscillating;
  if (tail_contact_ticks_ > 0 && contact_penetration_m_ > 0.0) {
    // A penetration may be the smallest number there is; a summary is finite.
    constexpr double kMost = std::numeric_limits<double>::max();
    summary.displayed_stiffness_n_per_m =
        std::clamp(contact_force_n_ / contact_penetration_m_, -kMost, kMost);
  }
  if (has_wall && max_penetration_m_ > -kInfinity) summary.max_penetration_m = max_penetration_m_;
  summary.peak_force_n = peak_force_n_;
  summary.saturated_ticks = saturated_ticks_;
  summary.contacts = contacts_;
  summary.min_energy_cv_j = min_energy_cv_j_;
  summary.min_energy_scv_j = min_energy_scv_j_;
}

Metrics::Metrics(const Scene& scene, std::uint64_t planned_ticks, bool has_truth)
    : scene_(scene),
      has_truth_(has_truth),
      ticks_(tail_begin_tick(planned_ticks, scene.sampling.rate_hz)) {}

void Metrics::add(const Sample& sample) {
  const double position_m = has_truth_ ? sample.truth.position_m : sample.position_m;
  if (diverged_at_tick_) return;
  if (has_diverged(position_m) || !std::isfinite(sample.force_n)) {
    diverged_at_tick_ = sample.tick;
    return;
  }
  if (has_truth_) {
    if (!initial_kinetic_j_) initial_kinetic_j_ = sample.truth.kinetic_j;
    const PlantTruth& truth = sample.truth;
    ticks_.add_net_work(truth.actuator_work_j + truth.dissipation_j + truth.kinetic_j -
                        *initial_kinetic_j_);
  }
  const EnergyLedger ledger{sample.energy_cv_j, sample.energy_hold_j, sample.energy_scv_j,
                            sample.energy_budget_j};
  ticks_.add(count_++,
             {position_m, sample.penetration_m, sample.force_n,
              (sample.flags & kFlagInContact) != 0, (sample.flags & kFlagForceLimit) != 0},
             ledger);
  last_ = sample;
}

Summary Metrics::finish() const {
  Summary summary;
  summary.scene = scene_.name;
  summary.algorithm = algorithms()[scene_.algorithm.index].name;
  summary.ticks = count_;
  summary.duration_s = static_cast<double>(count_) / scene_.sampling.rate_hz;
  ticks_.write(summary, !scene_.walls.empty());
  summary.diverged_at_tick = diverged_at_tick_;
  if (diverged_at_tick_) summary.verdict = Verdict::kDiverged;
  summary.energy_cv_j = last_.energy_cv_j;
  summary.energy_hold_j = last_.energy_hold_j;
  summary.energy_scv_j = last_.energy_scv_j;
  summary.energy_budget_j = last_.energy_budget_j;
  if (has_truth_ && initial_kinetic_j_) {
    const PlantTruth& truth = last_.truth;
    summary.true_actuator_work_j = truth.actuator_work_j;
    summary.true_dissipation_j = truth.dissipation_j;
    summary.true_hand_work_j = truth.hand_work_j;
    summary.kinetic_j = truth.kinetic_j;
    summary.energy_balance_error_j =
        truth.hand_work_j -
        (truth.kinetic_j - *initial_kinetic_j_ + truth.dissipation_j + truth.actuator_work_j);
    summary.passivity_margin_j = ticks_.passivity_margin_j();
  }
  return summary;
}

}  // namespace hapticwall
