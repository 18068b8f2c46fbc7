// Judges what a real device says, tick by tick: a report can be well formed and wrong. A simulator
// is never judged. Arithmetic only: no clock, no device. Realtime-safe: yes, all of it.
#pragma once

#include <cstdint>

#include "app/runtime/loop/arming.h"
#include "core/loop/device_reading.h"
#include "device/device.h"

namespace hapticwall::runtime {

// From the latch of a position to the acknowledgement of its force. A slower device gets no force.
inline constexpr double kMaxCommandAgeS = 0.02;
// A force that is not the commanded one may be told in so many states.
inline constexpr std::uint32_t kMaxOtherWords = 3;
// A handle may be pushed so far against the full force of a device that acknowledges nothing: its
// position alone can show that it does not push, or pushes the other way.
inline constexpr double kMaxGivenWayM = 0.03;

class DeviceJudge {
 public:
  explicit DeviceJudge(const device::DeviceInfo& info)
      : motion_(info.motion), encoder_m_(info.encoder_m) {}

  // What is wrong at this tick; kNone without objection. `elapsed_s`: since the previous call, by
  // the host's clock, for a device without a clock.
  // `full_force`: the last command was the force limit, 1 out of the wall, -1 into it; else 0.
  [[nodiscard]] ArmingNote judge(const DeviceReading& reading, const device::LinkStats& link,
                                 double elapsed_s, int full_force = 0);
  // Motion until the next reading is unobserved.
  void forget() { known_ = false; }
  // No command of this link was acknowledged yet: its delay is unknown.
  [[nodiscard]] bool waits_for_answer() const { return waits_for_answer_; }

 private:
  [[nodiscard]] bool is_plausible(const DeviceReading& reading, double elapsed_s);
  [[nodiscard]] ArmingNote answer(const device::LinkStats& link);
  [[nodiscard]] bool gives_way(double position_m, int full_force);

  device::MotionLimits motion_;
  double encoder_m_;
  bool known_ = false;
  double position_m_ = 0.0;  // of the last report
  double device_time_s_ = 0.0;
  double since_s_ = 0.0;  // since the last report, by the host's clock
  std::uint64_t rejected_ = 0;
  bool waits_for_answer_ = false;
  int pushed_ = 0;       // the last full_force
  double held_m_ = 0.0;  // the farthest that the present full force has pushed
};

}  // namespace hapticwall::runtime
