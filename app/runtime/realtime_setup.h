// What the loop asks of the operating system. This file and its .cpp are all of the runtime that is
// Linux's own: another system is another .cpp.
#pragma once

#include <cstdint>
#include <string>

#include "app/runtime/clock.h"
#include "app/runtime/session.h"

namespace hapticwall::runtime {

// SCHED_FIFO priority of the loop: above everything a desktop runs, below the kernel's own
// watchdogs.
inline constexpr int kLoopPriority = 80;

// How each part of the set-up ended: 0, or the error number of the system call that refused.
struct RealtimeOutcome {
  int priority = 0;  // that was asked for
  int priority_error = 0;
  int lock_error = 0;
  int affinity_core = -1;  // that was asked for; -1: none
  int affinity_error = 0;
};

// The outcome in words, with advice where something was refused. Realtime-safe: no.
[[nodiscard]] RealtimeStatus describe(const RealtimeOutcome& outcome);

// Why a session on this device is not to be, or nothing: a late force is a wrong force, and a hand
// is on the other end. Realtime-safe: no.
[[nodiscard]] Failure refuse_without_realtime(const device::DeviceInfo& device,
                                              const RealtimeStatus& status, bool allowed);

// Sets the calling thread up as the real-time loop, as far as the system permits: the default
// floating-point environment, a touched stack, no signals, SCHED_FIFO, memory lock (for the whole
// process, and for good), affinity. Nothing here is needed to run; what is refused is told.
// `affinity_core` -1: left to the scheduler. Realtime-safe: no.
RealtimeOutcome set_up_realtime_thread(int affinity_core);

// Sets the calling thread up as one that carries a device's reports: just below the loop, as far as
// the system permits. Realtime-safe: no.
void set_up_device_thread();

// Sets the calling thread up as one that takes rows to the disk: before everything that is
// ordinary, so that busy cores cost no row, and after everything else that is real-time; as far as
// the system permits. Realtime-safe: no.
void set_up_recorder_thread();

// Round to nearest, denormals kept: every machine and every thread gets the same bits. A library
// built with -ffast-math may have switched denormals off for the whole process before.
// Realtime-safe: no.
void use_default_floating_point();

// CLOCK_MONOTONIC with absolute deadlines.
class MonotonicClock : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() override;
  void sleep_until_ns(std::int64_t deadline_ns) override;
};

}  // namespace hapticwall::runtime
