#include "core/run/metrics.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/algorithm/algorithm.h"

namespace hapticwall {
namespace {

void write_tail(const RunStats& stats, Summary& summary) {
  if (stats.tail_ticks == 0) return;
  summary.tail_peak_to_peak_m = stats.tail_way.peak_to_peak_m();
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

// A signal that swings as a sine has √2 times its root-mean-square as its amplitude.
constexpr double kPeakToPeakOfSine = 2.0 * std::numbers::sqrt2;

void write_touch(const TouchStats& touch, const PieceStats& pieces, double rate_hz, bool has_truth,
                 Summary& summary) {
  if (pieces.judged > 0) {
    summary.chatter_n = pieces.force_n;
    summary.swing_m = kPeakToPeakOfSine * pieces.position_m;
    if (has_truth) summary.shake_m_per_s2 = pieces.acceleration_m_per_s2;
  }
  summary.given_j = touch.given_j;
  if (touch.contact_ticks > 0) {
    summary.given_w = touch.given_j * rate_hz / static_cast<double>(touch.contact_ticks);
  }
}

double rest_limit_m(const DeviceSettings& device, bool has_truth) {
  return has_truth ? kSettledPeakToPeakM
                   : kSettledPeakToPeakM + std::numbers::sqrt2 * device.encoder_m.value_or(0.0);
}

double chatter_limit_n(const DeviceSettings& device) {
  return device.force_limit_n ? std::min(kMaxChatterN, kMaxChatterShare * *device.force_limit_n)
                              : kMaxChatterN;
}

bool turns(const Way& way, double limit_m) {
  constexpr double kOneWay = 0.9;  // of the way from peak to peak
  return way.peak_to_peak_m() > limit_m &&
         std::abs(way.last_m - way.first_m) < kOneWay * way.peak_to_peak_m();
}

// True unless the handle drifts one way. The last half second tells a swing from a drift if the
// tail holds an odd number of half swings. A swing that dies away has half of its way there.
bool to_and_fro(const RunStats& stats, double limit_m) {
  return stats.tail_way.peak_to_peak_m() > limit_m &&
         (turns(stats.tail_way, limit_m) || turns(stats.tail_end_way, 0.5 * limit_m));
}

// The first word that applies.
Verdict verdict_of(const Summary& summary, const RunStats& stats, const DeviceSettings& device,
                   const RunEnd& end) {
  if (end.diverged_at_tick) return Verdict::kDiverged;
  if (!summary.tail_peak_to_peak_m) return Verdict::kOscillating;  // see has_verdict()
  if (stats.touch.touches == 0) return Verdict::kNoContact;
  const double limit_m = rest_limit_m(device, end.has_truth);
  const bool rests = *summary.tail_peak_to_peak_m <= limit_m;
  if (summary.chatter_n.value_or(0.0) > chatter_limit_n(device)) {
    const bool swings = end.hand_rests ? !rests : *summary.swing_m > limit_m;
    return swings ? Verdict::kOscillating : Verdict::kBuzzing;
  }
  if (end.hand_rests && to_and_fro(stats, limit_m)) return Verdict::kOscillating;
  const bool at_rest = end.hand_rests && rests;
  if (summary.given_w.value_or(0.0) > kMaxGivenW && !at_rest) return Verdict::kActive;
  return rests ? Verdict::kSettled : Verdict::kMoving;
}

std::optional<std::string> note_of(const Summary& summary, const RunStats& stats) {
  if (stats.tail_ticks == 0) return std::nullopt;
  if (summary.duration_s < kTailS) return kShortRun;
  if (stats.touch.touches > 0 && !summary.chatter_n) return kShortTouches;
  return std::nullopt;
}

// Times of points are rounded; a motion that overlaps by less than this many ticks is none.
constexpr double kRoundingTicks = 1e-6;

bool rests(const std::vector<PathPoint>& points, double rate_hz, double from_tick,
           double last_tick) {
  const auto moves = [&](const PathPoint& a, const PathPoint& b) {
    return a.position_m != b.position_m && a.time_s * rate_hz < last_tick - kRoundingTicks &&
           b.time_s * rate_hz > from_tick + kRoundingTicks;
  };
  return std::ranges::adjacent_find(points, moves) == points.end();
}

bool rests(const std::vector<PathPiece>& pieces, double from_tick, double last_tick) {
  std::optional<double> place_m;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool is_over = i + 1 < pieces.size() && pieces[i + 1].from_tick <= from_tick;
    if (is_over || pieces[i].from_tick > last_tick) continue;
    const bool moves = pieces[i].velocity_m_per_s != 0.0 && last_tick > from_tick;
    if (moves || (place_m && pieces[i].position_m != *place_m)) return false;
    place_m = pieces[i].position_m;
  }
  return true;
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
  write_touch(stats.touch, end.hand_rests ? stats.touch.tail_pieces : stats.touch.pieces,
              scene.sampling.rate_hz, end.has_truth, summary);
  summary.verdict = verdict_of(summary, stats, scene.x().device, end);
  summary.verdict_note = note_of(summary, stats);
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

bool hand_rests(const Scene& scene, std::uint64_t from, std::uint64_t end) {
  if (!scene.x().hand || end == 0) return true;
  const HandSettings& hand = *scene.x().hand;
  if (hand.follows_mouse) return false;
  const auto from_tick = static_cast<double>(from);
  const auto last_tick = static_cast<double>(end - 1);
  if (hand.path.recorded) return rests(hand.path.recorded->pieces, from_tick, last_tick);
  return rests(hand.path.points(), scene.sampling.rate_hz, from_tick, last_tick);
}

TickMetrics tick_metrics(const Scene& scene) {
  const std::uint64_t tail = tail_begin_tick(scene.tick_count(), scene.sampling.rate_hz);
  return {scene.sampling.rate_hz, tail, hand_rests(scene, tail, scene.tick_count()) ? tail : 0};
}

Metrics::Metrics(const Scene& scene, std::uint64_t planned_ticks, SampleOrigin origin)
    : scene_(scene),
      origin_(origin),
      tail_begin_tick_(tail_begin_tick(planned_ticks, scene.sampling.rate_hz)),
      ticks_(scene.sampling.rate_hz, tail_begin_tick_, 0) {}

double Metrics::absorbed_by_device_j(const Sample& sample) {
  if (origin_ == SampleOrigin::kDevice) return sample.energy_scv_j - sample.energy_budget_j;
  return applied_.absorbed_j(sample.position_m, sample.applied_force_n, sample.energy_budget_j);
}

void Metrics::add(const Sample& sample) {
  const bool has_truth = origin_ == SampleOrigin::kSimulator;
  const PlantTruth& truth = sample.truth;
  const double position_m = has_truth ? truth.position_m : sample.position_m;
  if (end_.diverged_at_tick || has_diverged(position_m) || !std::isfinite(sample.force_n)) {
    if (!end_.diverged_at_tick) diverge(sample.tick);
    // A device was commanded, wherever its handle went.
    if (!has_truth) ticks_.add_force(sample.force_n);
    return;
  }
  double absorbed_j = 0.0;
  if (has_truth) {
    if (!initial_kinetic_j_) initial_kinetic_j_ = truth.kinetic_j;
    absorbed_j = truth.actuator_work_j + truth.dissipation_j;
    ticks_.add_net_work(absorbed_j + truth.kinetic_j - *initial_kinetic_j_);
    if (end_.ticks == tail_begin_tick_) {
      tail_path_m_ = truth.hand_path_m;
      hand_rests_ = true;
    }
    if (tail_path_m_ && truth.hand_path_m != *tail_path_m_) hand_rests_ = false;
  } else {
    absorbed_j = absorbed_by_device_j(sample);
  }
  ticks_.add(end_.ticks++,
             {position_m, truth.velocity_m_per_s, absorbed_j, sample.penetration_m, sample.force_n,
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
  RunEnd end = end_;
  end.hand_rests = hand_rests_;
  end.has_truth = origin_ == SampleOrigin::kSimulator;
  return summarise(scene_, ticks_.stats(), ledger_of(last_), energies, end);
}

}  // namespace hapticwall
