// Removes the force before a crash: a signal that would end the process at once (a fault, an
// uncaught exception, a closed terminal) first ends every loop with zero force.
//
// It cannot help against SIGSEGV and other faults on the loop's or a device's thread: these block
// all signals, and the kernel ends the process at once. The device then drops the force after its
// time to live, 20 ms (docs/hid-protocol.md). abort() unblocks its signal and is caught there, too.
#pragma once

#include <cstdint>

namespace hapticwall::session {

// Time limit of a dying process for its loops: a loop of 1 kHz needs one tick, but closing the
// device may hang after a fault.
inline constexpr std::int64_t kMaxLastWaitNs = 50'000'000;

// While one exists, the signals that end a process at once are caught: those of a fault always,
// others (closed terminal, Ctrl-\) if they have no other handler. The handler ends every loop with
// zero force. Then the process ends as it would have without it: by the same signal, at the same
// instruction, through the previous handler. The last CrashStop restores the handlers. Once one has
// existed, exit() ends every loop with zero force, too (early_exit.h).
//
// It gives the constructing thread a signal stack if that has none, because a stack overflow is a
// fault, too. Realtime-safe: no.
class CrashStop {
 public:
  CrashStop();
  CrashStop(const CrashStop&) = delete;
  CrashStop& operator=(const CrashStop&) = delete;
  ~CrashStop();
};

// Counts as a loop with force during its lifetime, on the thread that constructs it.
// Realtime-safe: yes.
class LoopWithForce {
 public:
  // `remove_force(loop)` commands zero. It is called on this thread if the process ends on it, and
  // the loop never continues; a signal handler may be the caller.
  LoopWithForce(void (*remove_force)(void* loop) noexcept, void* loop) noexcept;
  LoopWithForce(const LoopWithForce&) = delete;
  LoopWithForce& operator=(const LoopWithForce&) = delete;
  ~LoopWithForce();
};

// True once the process is about to end. Every loop checks it before every cycle. Realtime-safe:
// yes.
[[nodiscard]] bool must_end_force() noexcept;

// Ends every loop for good, and waits for their zero force at most kMaxLastWaitNs. On a loop's own
// thread, and in a call of a device plug-in that holds its zero force back, it removes that force
// itself; there SIGALRM ends the process if it does not return within a second. May be called in a
// signal handler. Realtime-safe: no.
void end_all_force() noexcept;

// end_all_force(), then ends the process by this signal; in a handler of that signal, when the
// handler returns. Realtime-safe: no.
void end_by(int signal) noexcept;

}  // namespace hapticwall::session
