// The loop's clock, replaced in tests.
#pragma once

#include <cstdint>

namespace hapticwall::session {

inline constexpr double kNanosecondsPerSecond = 1e9;

class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  // Nanoseconds since a fixed instant; monotonic. Realtime-safe: yes.
  [[nodiscard]] virtual std::int64_t now_ns() = 0;

  // Returns at `deadline_ns` or later; at once if that has passed. Realtime-safe: yes (it waits,
  // but never inside a tick).
  virtual void sleep_until_ns(std::int64_t deadline_ns) = 0;
};

}  // namespace hapticwall::session
