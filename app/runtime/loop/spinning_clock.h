// Sleeping that ends early and waits out the rest awake: a processor that never rests long wakes up
// sooner. It costs processor time, and the user chooses it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/runtime/clock.h"

namespace hapticwall::runtime {

// The most of a period that is waited awake: real-time threads that leave nothing to others are
// stopped by the kernel for a while.
inline constexpr double kMostSpinOfPeriod = 0.9;
inline constexpr double kMostSpinS = 0.1;

// `spin_s` 0 to kMostSpinS, as it is possible at this rate. Realtime-safe: yes.
[[nodiscard]] inline std::int64_t spin_ns(double spin_s, double rate_hz) {
  return std::llround(std::min(spin_s, kMostSpinOfPeriod / rate_hz) * kNanosecondsPerSecond);
}

// Another clock, but awake for the last `spin_ns` before a deadline. 0: just the other clock.
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
