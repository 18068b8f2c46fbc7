#include "core/study/first_contact.h"

#include <algorithm>

namespace hapticwall {
namespace {

bool in_contact(const Sample& sample) { return (sample.flags & kFlagInContact) != 0; }
bool at_limit(const Sample& sample) { return (sample.flags & kFlagForceLimit) != 0; }

}  // namespace

void FirstContact::add(const Sample& sample) {
  if (phase_ == Phase::kOver) return;
  if (phase_ == Phase::kRising) {
    follow(sample);
  } else if (!in_contact(sample)) {
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
  if (!in_contact(sample) || sample.force_n < last_force_n_) {
    phase_ = Phase::kOver;
    return;
  }
  last_force_n_ = sample.force_n;
  const double elapsed_s = static_cast<double>(sample.tick - entry_tick_) * period_s_;
  if (sample.force_n > entry_force_n_) {
    const bool initial = elapsed_s <= kInitialRiseS;
    if (initial || !steepest_n_per_s_) {
      steepest_n_per_s_ =
          std::max(steepest_n_per_s_.value_or(0.0), (sample.force_n - entry_force_n_) / elapsed_s);
    }
    if (!initial) phase_ = Phase::kOver;
  }
  if (at_limit(sample)) phase_ = Phase::kOver;
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
