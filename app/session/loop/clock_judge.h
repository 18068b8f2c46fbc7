// The clock of a device against that of the host, period against period. Arithmetic only.
// Realtime-safe: yes, all of it.
#pragma once

#include <cmath>

#include "app/session/loop/arming.h"

namespace hapticwall::session {

// The clocks are compared over this time, and may differ by this share of it.
inline constexpr double kClockWindowS = 0.1;
inline constexpr double kClockTolerance = 0.05;
// Allowed difference of the clocks between two reports, because reports may be delayed.
inline constexpr double kMaxClockJumpS = 0.02;

class ClockJudge {
 public:
  // A report: its latch by the device's clock, and its arrival by the host's, seconds.
  [[nodiscard]] ArmingNote hear(double device_s, double arrival_s) {
    if (!begun_) return begin(device_s, arrival_s);
    if (device_s == device_s_) return rate_;
    const double jump_s = (device_s - device_s_) - (arrival_s - arrival_s_);
    device_s_ = device_s;
    arrival_s_ = arrival_s;
    if (std::abs(jump_s) > kMaxClockJumpS) {
      forget();
      static_cast<void>(begin(device_s, arrival_s));
      return ArmingNote::kClockJump;
    }
    const double window_s = arrival_s - from_arrival_s_;
    if (window_s < kClockWindowS) return rate_;
    const double ratio = (device_s - from_device_s_) / window_s;
    rate_ = std::abs(ratio - 1.0) <= kClockTolerance ? ArmingNote::kNone : ArmingNote::kClockRate;
    known_ = true;
    from_device_s_ = device_s;
    from_arrival_s_ = arrival_s;
    return rate_;
  }
  void forget() { *this = ClockJudge(); }
  [[nodiscard]] bool known() const { return known_; }

 private:
  ArmingNote begin(double device_s, double arrival_s) {
    begun_ = true;
    device_s_ = from_device_s_ = device_s;
    arrival_s_ = from_arrival_s_ = arrival_s;
    return ArmingNote::kNone;
  }

  bool begun_ = false;
  bool known_ = false;  // a whole window was compared
  ArmingNote rate_ = ArmingNote::kNone;
  double device_s_ = 0.0;  // device time of the last report
  double arrival_s_ = 0.0;
  double from_device_s_ = 0.0;  // of the present window
  double from_arrival_s_ = 0.0;
};

}  // namespace hapticwall::session
