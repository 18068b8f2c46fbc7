// Threads, their wake-ups and the clock, from the operating system.
#pragma once

#include <semaphore.h>

#include <chrono>
#include <functional>
#include <thread>

namespace hapticwall::device {

// Wakes a waiting thread. Several posts may give one wake-up.
class WakeSignal {
 public:
  WakeSignal();
  WakeSignal(const WakeSignal&) = delete;
  WakeSignal& operator=(const WakeSignal&) = delete;
  ~WakeSignal();

  // Never waits. Realtime-safe: yes.
  void post();
  // Returns after a post since the last return, or after `longest`.
  void wait(std::chrono::milliseconds longest);

 private:
  sem_t semaphore_{};
};

// A thread with all signals blocked. Throws std::system_error if the system has no more threads.
// Realtime-safe: no.
[[nodiscard]] std::thread start_thread(std::function<void()> body);

// Nanoseconds of a monotonic clock. Realtime-safe: yes.
[[nodiscard]] std::int64_t monotonic_ns();

}  // namespace hapticwall::device
