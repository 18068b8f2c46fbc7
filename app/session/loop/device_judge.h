// Judges what a real device says, tick by tick: a report can be well formed and wrong. A simulator
// is never judged. Arithmetic only: no clock, no device. Realtime-safe: yes, all of it.
#pragma once

#include <cstdint>

#include "app/session/loop/arming.h"
#include "app/session/loop/clock_judge.h"
#include "app/session/loop/given_way.h"
#include "app/session/loop/motion_judge.h"
#include "app/session/loop/obedience.h"
#include "core/tick/device_reading.h"
#include "device/device.h"

namespace hapticwall::session {

// Max time from the latch of a position to the acknowledgement of its force. A slower device gets
// no force.
inline constexpr double kMaxCommandAgeS = 0.02;
// Max delay, in periods, of a device that is armed without --allow-slow-device. The device's tick
// and the loop's differ by parts in a thousand, hence the tolerance.
inline constexpr double kUsableDelayTicks = 5.0;
inline constexpr double kDelayTolerance = 1.01;
// Max growth of the delay after arming, in ticks; up to kMaxLateAnswers - 1 acknowledgements in a
// row may exceed it.
inline constexpr double kMaxDelayGrowthTicks = 3.0;
inline constexpr std::uint32_t kMaxLateAnswers = 4;
// Max number of states in a row that report another force than the commanded one.
inline constexpr std::uint32_t kMaxOtherWords = 3;

struct JudgeOptions {
  double rate_hz = 1000.0;         // tick rate of the loop
  bool allow_slow_device = false;  // arms a device with a poor delay
};

// Facts of a tick that the host knows.
struct JudgedTick {
  double elapsed_s = 0.0;      // since the previous call
  double force_n = 0.0;        // force of the last command
  double force_limit_n = 0.0;  // positive
  bool armed = false;
};

class DeviceJudge {
 public:
  explicit DeviceJudge(const device::DeviceInfo& info, const JudgeOptions& options = {});

  // The fault at this tick; kNone without objection.
  [[nodiscard]] ArmingNote judge(const DeviceReading& reading, const device::LinkStats& link,
                                 const JudgedTick& tick);
  // Motion until the next reading is unobserved.
  void forget();
  // The device's delay or the rate of its clock is not known yet.
  [[nodiscard]] bool waits_for_answer() const { return waits_for_answer_; }
  // Obedience for the next force: less than full force until the handle has obeyed.
  [[nodiscard]] const Obedience& obedience() const { return obedience_; }

 private:
  [[nodiscard]] ArmingNote answer(const device::LinkStats& link);
  [[nodiscard]] ArmingNote force_word(const device::LinkStats& link) const;
  [[nodiscard]] ArmingNote clock(const DeviceReading& reading, const device::LinkStats& link);
  [[nodiscard]] ArmingNote delay(const device::LinkStats& link);
  [[nodiscard]] ArmingNote obeys(double position_m, double delay_s, const JudgedTick& tick);
  void arm(bool armed, const device::LinkStats& link);

  JudgeOptions options_;
  MotionJudge motion_;
  ClockJudge clock_;
  Obedience obedience_;
  GivenWay given_way_;
  double host_s_ = 0.0;  // time since the start by the host's clock
  std::uint64_t rejected_ = 0;
  bool waits_for_answer_ = false;
  bool armed_ = false;
  double armed_delay_s_ = 0.0;  // when it was armed; 0: unknown
  std::uint64_t answers_ = 0;
  std::uint32_t late_answers_ = 0;  // consecutive late answers
};

// Direction of a force at the limit: 1 out of the wall, -1 into it; else 0. Realtime-safe: yes.
[[nodiscard]] int full_force(double force_n, double force_limit_n);

}  // namespace hapticwall::session
