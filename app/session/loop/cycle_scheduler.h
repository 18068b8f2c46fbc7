// Deadlines of a fixed-rate loop: arithmetic only, no clock.
//
// Deadline k is start + round(k * 1e9 / rate), computed from k so that 3 kHz does not drift. A late
// cycle is executed once and keeps the phase: whole periods it slept through count as missed.
#pragma once

#include <cmath>
#include <cstdint>

#include "app/session/loop/clock.h"

namespace hapticwall::session {

// One wake-up of the loop.
struct Wake {
  std::int64_t now_ns = 0;
  std::int64_t latency_ns = 0;  // after the deadline
  std::uint64_t missed = 0;     // later deadlines that have also passed
};

// Realtime-safe: yes, every member.
class CycleScheduler {
 public:
  // `rate_hz` > 0. The first deadline is one period after `start_ns`.
  CycleScheduler(double rate_hz, std::int64_t start_ns) : rate_hz_(rate_hz), start_ns_(start_ns) {}

  // Deadline of the next cycle.
  [[nodiscard]] std::int64_t deadline_ns() const { return deadline_of(next_); }

  // Takes a wake-up at `now_ns` (not before deadline_ns()) and moves to the first deadline after
  // it.
  Wake wake(std::int64_t now_ns) {
    Wake wake{now_ns, now_ns - deadline_ns(), 0};
    const std::uint64_t first_future = first_deadline_after(now_ns);
    wake.missed = first_future - next_ - 1;
    next_ = first_future;
    return wake;
  }

  // Leaves out this many deadlines, which do not count as missed.
  void skip(std::uint64_t deadlines) { next_ += deadlines; }

 private:
  // long double: k * 1e9 exceeds the 53 bits of a double after two and a half hours at 1 kHz.
  [[nodiscard]] std::int64_t deadline_of(std::uint64_t index) const {
    constexpr auto kNanoseconds = static_cast<long double>(kNanosecondsPerSecond);
    return start_ns_ + std::llroundl(static_cast<long double>(index) * kNanoseconds /
                                     static_cast<long double>(rate_hz_));
  }

  // Estimates from the elapsed time, then corrects for the rounding of deadlines; constant time.
  [[nodiscard]] std::uint64_t first_deadline_after(std::int64_t now_ns) const {
    std::uint64_t index = next_ + 1;
    const double late_ns = static_cast<double>(now_ns - deadline_ns());
    const double periods = std::floor(late_ns * rate_hz_ / kNanosecondsPerSecond);
    if (periods > 1.0) index += static_cast<std::uint64_t>(periods) - 1;
    while (deadline_of(index) <= now_ns) ++index;
    return index;
  }

  double rate_hz_;
  std::int64_t start_ns_;
  std::uint64_t next_ = 1;
};

}  // namespace hapticwall::session
