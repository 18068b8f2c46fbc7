// Who calls the cycles of a loop: its own thread, or the owner of its session.
#pragma once

#include <cstdint>
#include <memory>

#include "app/session/loop/clock.h"
#include "app/session/loop/exchange.h"
#include "app/session/loop/realtime_setup.h"
#include "app/session/loop/servo_loop.h"

namespace hapticwall::session {

enum class Driver : std::uint8_t { kOwnThread, kTurnedByOwner };

// Loop, exchange and clock outlive it. The destructor ends the loop with zero force.
class LoopDriver {
 public:
  LoopDriver() = default;
  LoopDriver(const LoopDriver&) = delete;
  LoopDriver& operator=(const LoopDriver&) = delete;
  virtual ~LoopDriver() = default;

  // How the thread of the cycles is set up.
  [[nodiscard]] virtual const RealtimeStatus& status() const = 0;
  // Runs every cycle that is due; nothing where the loop has its own thread.
  virtual void turn() = 0;
  // Lets a cycle or a moment pass: the owner waits for an answer of the loop.
  virtual void wait() = 0;
};

// The thread runs run_servo_loop(). Returns when it is set up; throws std::system_error if the
// system has no more threads. `affinity_core`: as for set_up_realtime_thread(). Realtime-safe: no.
[[nodiscard]] std::unique_ptr<LoopDriver> start_loop_thread(ServoLoop& loop, Exchange& exchange,
                                                            double rate_hz, Clock& clock,
                                                            int affinity_core);

// A turn makes up for this time at most. A longer gap, as of a hidden window, is left out and
// counts as no missed tick.
inline constexpr std::int64_t kMaxTurnNs = 100'000'000;

// The owner's turns run the cycles, each as if it had begun at its deadline. For simulators alone:
// a hand on a device must not wait for a window.
[[nodiscard]] std::unique_ptr<LoopDriver> turned_by_owner(ServoLoop& loop, Exchange& exchange,
                                                          double rate_hz, Clock& clock);

// The thread's body: cycles at `rate_hz` until the exchange says stop. It always ends with zero
// force and closed devices, also after an exception. Realtime-safe: yes, from the first cycle to
// the last.
void run_servo_loop(ServoLoop& loop, Exchange& exchange, double rate_hz, Clock& clock) noexcept;

}  // namespace hapticwall::session
