#include "app/runtime/loop/device_judge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/loop/servo_step.h"

namespace hapticwall::runtime {

ArmingNote DeviceJudge::judge(const DeviceReading& reading, const device::LinkStats& link,
                              double elapsed_s, int full_force) {
  ArmingNote answered = answer(link);
  if (reading.state != DeviceState::kOk) {  // says so itself
    forget();
    return ArmingNote::kNone;
  }
  if (!link.acknowledges && gives_way(reading.position_m, full_force)) {
    answered = ArmingNote::kGivesWay;
  }
  return is_plausible(reading, elapsed_s) ? answered : ArmingNote::kImplausible;
}

// A force out of the wall pushes to smaller positions.
bool DeviceJudge::gives_way(double position_m, int full_force) {
  if (std::exchange(pushed_, full_force) != full_force || full_force == 0) held_m_ = position_m;
  held_m_ = full_force > 0 ? std::min(held_m_, position_m) : std::max(held_m_, position_m);
  return full_force != 0 && (position_m - held_m_) * full_force > kMaxGivenWayM;
}

// By the device's clock, else by the host's. No report is trusted to be older than a position may
// be: a clock that runs fast hides no jump.
bool DeviceJudge::is_plausible(const DeviceReading& reading, double elapsed_s) {
  since_s_ += elapsed_s;
  const double moved_m = std::abs(reading.position_m - position_m_);
  const double ticked_s = reading.device_time_s - device_time_s_;
  if (known_ && moved_m == 0.0 && ticked_s == 0.0) return true;  // the same report
  const double passed_s = std::min(ticked_s != 0.0 ? ticked_s : since_s_, kDefaultMaxAgeS);
  const bool slow = !known_ || moved_m <= motion_.max_speed_m_per_s * passed_s + encoder_m_;
  position_m_ = reading.position_m;
  device_time_s_ = reading.device_time_s;
  since_s_ = 0.0;
  const bool inside = reading.position_m >= motion_.min_m && reading.position_m <= motion_.max_m;
  known_ = inside;
  return slow && inside;
}

ArmingNote DeviceJudge::answer(const device::LinkStats& link) {
  const std::uint64_t before = std::exchange(rejected_, link.rejected_commands);
  waits_for_answer_ =
      link.connected && link.acknowledges && link.force_word == device::ForceWord::kNone;
  if (!link.connected) return ArmingNote::kNone;
  if (!link.acknowledges) {
    return link.delay_s > kMaxCommandAgeS ? ArmingNote::kSlowAnswer : ArmingNote::kNone;
  }
  if (link.rejected_commands > before) return ArmingNote::kRejected;
  if (link.command_age_s > kMaxCommandAgeS) {
    // A slow device still acknowledges one command after the other.
    return link.unanswered_s > 0.5 * kMaxCommandAgeS ? ArmingNote::kNoAnswer
                                                     : ArmingNote::kSlowAnswer;
  }
  switch (link.force_word) {
    case device::ForceWord::kNotEnabled:
      return ArmingNote::kNotEnabled;
    case device::ForceWord::kNoForce:
      return ArmingNote::kNoForce;
    case device::ForceWord::kOther:
      return link.same_words > kMaxOtherWords ? ArmingNote::kOtherForce : ArmingNote::kNone;
    case device::ForceWord::kNone:
    case device::ForceWord::kSame:
      break;
  }
  return ArmingNote::kNone;
}

}  // namespace hapticwall::runtime
