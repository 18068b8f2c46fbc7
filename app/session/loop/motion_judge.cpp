#include "app/session/loop/motion_judge.h"

#include <algorithm>
#include <cmath>

#include "core/tick/servo_step.h"

namespace hapticwall::session {

// Judges by the device's clock, else by the host's. No report is trusted to be older than a
// position may be: a clock that runs fast hides no jump.
ArmingNote MotionJudge::judge(const DeviceReading& reading, double elapsed_s, bool has_clock,
                              double force_limit_n) {
  since_s_ += elapsed_s;
  const double moved_m = reading.position_m - position_m_;
  const double ticked_s = reading.device_time_s - device_time_s_;
  // The report is the previous one again.
  if (known_ && moved_m == 0.0 && ticked_s == 0.0) return ArmingNote::kNone;
  const double passed_s = std::min(ticked_s != 0.0 ? ticked_s : since_s_, kDefaultMaxAgeS);
  const double reach_m =
      (1.0 + kTimeTolerance) * motion_.max_speed_m_per_s * passed_s + kNoiseCounts * encoder_m_;
  const bool slow = !known_ || std::abs(moved_m) <= reach_m;
  const bool inside = reading.position_m >= motion_.min_m && reading.position_m <= motion_.max_m;
  position_m_ = reading.position_m;
  device_time_s_ = reading.device_time_s;
  since_s_ = 0.0;
  const bool was_known = known_;
  known_ = inside;
  if (!slow || !inside || !was_known || !has_clock) {
    speed_known_ = false;
    return slow && inside ? ArmingNote::kNone : ArmingNote::kImplausible;
  }
  return is_possible(moved_m, ticked_s, force_limit_n) ? ArmingNote::kNone
                                                       : ArmingNote::kAcceleration;
}

// The mean speeds of two intervals differ by at most the acceleration over half of both. The
// position between them counts in both.
bool MotionJudge::is_possible(double moved_m, double passed_s, double force_limit_n) {
  const double speed = moved_m / passed_s;
  const double before = speed_m_per_s_;
  const double before_s = passed_s_;
  const bool known = speed_known_;
  speed_m_per_s_ = speed;
  passed_s_ = passed_s;
  speed_known_ = true;
  if (!known) return true;
  const double max_m_per_s2 = (force_limit_n + kHandForceN) / motion_.mass_kg;
  const double noise = kNoiseCounts * encoder_m_ * (1.0 / passed_s + 1.0 / before_s) +
                       kTimeTolerance * (std::abs(speed) + std::abs(before));
  return std::abs(speed - before) <= max_m_per_s2 * 0.5 * (passed_s + before_s) + noise;
}

}  // namespace hapticwall::session
