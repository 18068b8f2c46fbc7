// The force goes before the program does: what would end the process at once (a fault in a panel,
// an exception that nobody catches, a terminal that is closed) first ends every loop with zero
// force.
//
// Not for a fault on the loop's own thread, or on one of a device's: they have every signal
// blocked, and the kernel ends the process on the spot. There the force ends by its own time to
// live, 20 ms at the device (docs/hid-protocol.md).
#pragma once

#include <cstdint>

namespace hapticwall::runtime {

// As long a dying process waits for its loops at most: a loop of 1 kHz needs one tick, and what it
// needs for closing the device may hang on what has just broken.
inline constexpr std::int64_t kLongestLastWaitNs = 50'000'000;

// While one lives, the signals that end a process at once are caught: those of a fault always,
// others (the terminal is closed, Ctrl-\) where nobody else has asked for them. Every loop then
// ends with zero force, and the process as it would have ended without all this: by the same
// signal, at the same instruction, through the same handler where there was one. What was caught
// before is so again when the last one is gone.
//
// It gives the thread that it is made on a stack for signals, where that has none: a stack that is
// full is a fault, too. Realtime-safe: no.
class CrashStop {
 public:
  CrashStop();
  CrashStop(const CrashStop&) = delete;
  CrashStop& operator=(const CrashStop&) = delete;
  ~CrashStop();
};

// A loop that may have force, as long as this lives. Realtime-safe: yes.
class LoopWithForce {
 public:
  LoopWithForce() noexcept;
  LoopWithForce(const LoopWithForce&) = delete;
  LoopWithForce& operator=(const LoopWithForce&) = delete;
  ~LoopWithForce();
};

// True once the process is about to end: every loop looks at it before every cycle, and ends.
// Realtime-safe: yes.
[[nodiscard]] bool must_end_force() noexcept;

// Ends the force of every loop, for good: returns when they have done so, after kLongestLastWaitNs
// at the latest. May be called in a signal handler. Realtime-safe: no.
void end_all_force() noexcept;

// The same, and then ends the process by this signal: in a handler of that signal when the handler
// returns. Realtime-safe: no.
void end_by(int signal) noexcept;

}  // namespace hapticwall::runtime
