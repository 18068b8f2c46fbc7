// Ends a sleep early and spins until the deadline: a processor that sleeps shortly wakes up sooner.
// It costs processor time, so the user chooses it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/session/loop/clock.h"

namespace hapticwall::session {

// Part of a period: the kernel throttles real-time threads that leave no time to others.
inline constexpr double kMaxSpinOfPeriod = 0.9;
inline constexpr double kMaxSpinS = 0.1;
// A loop whose ticks and spins fill its periods still sleeps once in so long, for an instant: the
// kernel takes a real-time thread that never sleeps for one that hangs (realtime_setup.h).
inline constexpr std::int64_t kMaxAwakeNs = 500'000'000;
inline constexpr std::int64_t kInstantNs = 20'000;

// `spin_s` (0 to kMaxSpinS), limited for this rate. Realtime-safe: yes.
[[nodiscard]] inline std::int64_t spin_ns(double spin_s, double rate_hz) {
  return std::llround(std::min(spin_s, kMaxSpinOfPeriod / rate_hz) * kNanosecondsPerSecond);
}

// Wraps another clock and spins for the last `spin_ns` before a deadline.
class SpinningClock : public Clock {
 public:
  SpinningClock(Clock& clock, std::int64_t spin_ns) : clock_(clock), spin_ns_(spin_ns) {}

  [[nodiscard]] std::int64_t now_ns() override { return clock_.now_ns(); }
  void sleep_until_ns(std::int64_t deadline_ns) override {
    const std::int64_t wake_ns = deadline_ns - spin_ns_;
    const std::int64_t now_ns = clock_.now_ns();
    if (slept_ns_ == 0) slept_ns_ = now_ns;
    if (now_ns < wake_ns) {
      clock_.sleep_until_ns(wake_ns);
      slept_ns_ = wake_ns;
    } else if (now_ns - slept_ns_ > kMaxAwakeNs) {
      clock_.sleep_until_ns(now_ns + kInstantNs);
      slept_ns_ = now_ns;
    }
    while (clock_.now_ns() < deadline_ns) {
    }
  }

 private:
  Clock& clock_;
  std::int64_t spin_ns_;
  std::int64_t slept_ns_ = 0;  // the newest sleep; 0: no call yet
};

}  // namespace hapticwall::session
