// Check that a handle can have moved as its device reports. Arithmetic only: no clock, no device.
// Realtime-safe: yes, all of it.
#pragma once

#include "app/session/loop/arming.h"
#include "core/tick/device_reading.h"
#include "device/device.h"

namespace hapticwall::session {

// A hand is not stronger. With the force limit it bounds the acceleration of the handle.
inline constexpr double kHandForceN = 50.0;
// The times of two reports may be wrong by this share of the time between them.
inline constexpr double kTimeTolerance = 0.05;
// Rounding, and a count of noise at each end.
inline constexpr double kNoiseCounts = 3.0;

class MotionJudge {
 public:
  explicit MotionJudge(const device::DeviceInfo& info)
      : motion_(info.motion), encoder_m_(info.encoder_m) {}

  // Precondition: the reading is no fault. `elapsed_s`: since the previous call, by the host's
  // clock, for a device without a clock. `has_clock`: its times are those of its own clock.
  [[nodiscard]] ArmingNote judge(const DeviceReading& reading, double elapsed_s, bool has_clock,
                                 double force_limit_n);
  // Motion until the next reading is unobserved.
  void forget() { known_ = speed_known_ = false; }

 private:
  [[nodiscard]] bool is_possible(double moved_m, double passed_s, double force_limit_n);

  device::MotionLimits motion_;
  double encoder_m_;
  bool known_ = false;
  bool speed_known_ = false;
  double position_m_ = 0.0;  // position in the last report
  double device_time_s_ = 0.0;
  double since_s_ = 0.0;        // since the last report, by the host's clock
  double speed_m_per_s_ = 0.0;  // mean speed between the last two reports
  double passed_s_ = 0.0;       // time between the last two reports
};

}  // namespace hapticwall::session
