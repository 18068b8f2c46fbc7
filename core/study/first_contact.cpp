#include "core/study/first_contact.h"

namespace hapticwall {
namespace {

bool touches(const Sample& sample) { return (sample.flags & kFlagInContact) != 0; }
bool at_limit(const Sample& sample) { return (sample.flags & kFlagForceLimit) != 0; }

}  // namespace

void FirstContact::add(const Sample& sample) {
  if (phase_ == Phase::kOver) return;
  if (phase_ == Phase::kRising) {
    follow(sample);
  } else if (!touches(sample)) {
    phase_ = Phase::kFree;
    free_force_n_ = sample.force_n;
  } else if (phase_ == Phase::kFree) {
    enter(sample);
  }
}

void FirstContact::enter(const Sample& sample) {
  entry_tick_ = sample.tick;
  speed_m_per_s_ = sample.truth.velocity_m_per_s;
  entry_force_n_ = last_force_n_ = sample.force_n;
  phase_ = at_limit(sample) ? Phase::kOver : Phase::kRising;
}

void FirstContact::follow(const Sample& sample) {
  if (!touches(sample) || sample.force_n < last_force_n_) {
    phase_ = Phase::kOver;
    return;
  }
  last_force_n_ = sample.force_n;
  const double elapsed_s = static_cast<double>(sample.tick - entry_tick_) * period_s_;
  const bool initial = elapsed_s <= kInitialRiseS;
  const bool limited = at_limit(sample);
  const RiseKind kind = limited ? RiseKind::kToTheLimit : RiseKind::kMean;
  if (sample.force_n > entry_force_n_ && (initial || !steepest_n_per_s_)) {
    take((sample.force_n - entry_force_n_) / elapsed_s, kind);
    if (limited) take((sample.force_n - free_force_n_) / (elapsed_s + period_s_), kind);
  }
  if (limited || (!initial && steepest_n_per_s_)) phase_ = Phase::kOver;
}

void FirstContact::take(double slope_n_per_s, RiseKind kind) {
  if (steepest_n_per_s_ && slope_n_per_s <= *steepest_n_per_s_) return;
  steepest_n_per_s_ = slope_n_per_s;
  kind_ = kind;
}

std::optional<double> FirstContact::approach_speed_m_per_s() const {
  if (phase_ == Phase::kUnknown || phase_ == Phase::kFree) return std::nullopt;
  return speed_m_per_s_;
}

std::optional<double> FirstContact::rate_hardness_n_per_m() const {
  const std::optional<double> speed = approach_speed_m_per_s();
  if (!speed || !(*speed > 0.0)) return std::nullopt;
  const double jump_n_per_s = (entry_force_n_ - free_force_n_) / period_s_;
  return steepest_n_per_s_.value_or(jump_n_per_s) / *speed;
}

}  // namespace hapticwall
