#include "app/session/loop/led_hand.h"

#include <algorithm>
#include <cmath>

#include "core/scene_keys.h"

namespace hapticwall::session {

void LedHand::next_tick(SpscQueue<HandMove>& moves, std::uint32_t gesture, double period_s,
                        const Places& present_m) {
  if (gesture != gesture_) {
    gesture_ = gesture;
    duration_s_ = passed_s_;  // ends the present move where the hand is
    anew_ = true;
  }
  double left_s = period_s;
  while (left_s > 0.0 && (passed_s_ < duration_s_ || begin_next(moves, present_m))) {
    const double rest_s = duration_s_ - passed_s_;
    passed_s_ = left_s < rest_s ? passed_s_ + left_s : duration_s_;
    left_s -= rest_s;
    const double share = duration_s_ > 0.0 ? passed_s_ / duration_s_ : 1.0;
    for (std::size_t i = 0; i < kMaxAxes; ++i)
      target_m_[i] = share < 1.0 ? from_m_[i] + share * (to_m_[i] - from_m_[i]) : to_m_[i];
  }
}

bool LedHand::begin_next(SpscQueue<HandMove>& moves, const Places& present_m) {
  HandMove move;
  do {
    if (!moves.try_pop(move)) return false;
  } while (move.gesture != gesture_);
  begin(move, present_m);
  return true;
}

void LedHand::begin(const HandMove& move, const Places& present_m) {
  double longest_m = 0.0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    from_m_[i] = anew_ ? present_m[i] : target_m_[i];
    const double wanted_m = move.to_place ? move.m[i] : from_m_[i] + move.m[i];
    to_m_[i] = std::isnan(wanted_m)
                   ? wanted_m
                   : std::clamp(wanted_m, kPositionRange.minimum, kPositionRange.maximum);
    longest_m = std::fmax(longest_m, std::abs(to_m_[i] - from_m_[i]));
  }
  duration_s_ = move.to_place ? longest_m / move.speed_m_per_s : move.duration_s;
  passed_s_ = 0.0;
  leads_ = true;
  anew_ = false;
}

}  // namespace hapticwall::session
