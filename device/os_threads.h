// What the link's threads need of the operating system.
#pragma once

#include <semaphore.h>

#include <chrono>
#include <functional>
#include <thread>

namespace hapticwall::device {

// Wakes a thread that waits. Any number of posts may be one wake-up.
class WakeSignal {
 public:
  WakeSignal();
  WakeSignal(const WakeSignal&) = delete;
  WakeSignal& operator=(const WakeSignal&) = delete;
  ~WakeSignal();

  // Never waits. Realtime-safe: yes.
  void post();
  // Returns when there was a post since the last return, or after `longest`.
  void wait(std::chrono::milliseconds longest);

 private:
  sem_t semaphore_{};
};

// A thread that no signal interrupts: they are for the program's own. Throws std::system_error
// where there are no more threads. Realtime-safe: no.
[[nodiscard]] std::thread start_thread(std::function<void()> body);

// Nanoseconds of a clock that never goes back. Realtime-safe: yes.
[[nodiscard]] std::int64_t monotonic_ns();

}  // namespace hapticwall::device
