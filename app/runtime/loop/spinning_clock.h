// Ends a sleep early and spins until the deadline: a processor that sleeps shortly wakes up sooner.
// It costs processor time, so the user chooses it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/runtime/loop/clock.h"

namespace hapticwall::runtime {

// Part of a period: the kernel throttles real-time threads that leave no time to others.
inline constexpr double kMaxSpinOfPeriod = 0.9;
inline constexpr double kMaxSpinS = 0.1;

// `spin_s` (0 to kMaxSpinS), limited for this rate. Realtime-safe: yes.
[[nodiscard]] inline std::int64_t spin_ns(double spin_s, double rate_hz) {
  return std::llround(std::min(spin_s, kMaxSpinOfPeriod / rate_hz) * kNanosecondsPerSecond);
}

// Another clock that spins for the last `spin_ns` before a deadline.
class SpinningClock : public Clock {
 public:
  SpinningClock(Clock& clock, std::int64_t spin_ns) : clock_(clock), spin_ns_(spin_ns) {}

  [[nodiscard]] std::int64_t now_ns() override { return clock_.now_ns(); }
  void sleep_until_ns(std::int64_t deadline_ns) override {
    clock_.sleep_until_ns(deadline_ns - spin_ns_);
    while (clock_.now_ns() < deadline_ns) {
    }
  }

 private:
  Clock& clock_;
  std::int64_t spin_ns_;
};

}  // namespace hapticwall::runtime
