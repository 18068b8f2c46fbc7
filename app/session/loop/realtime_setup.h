// Priority, memory lock, affinity and clock of the real-time threads. Only realtime_setup.cpp is
// specific to Linux.
#pragma once

#include <cstdint>
#include <string>

#include "app/session/loop/clock.h"
#include "core/result.h"
#include "device/device.h"

namespace hapticwall::session {

// SCHED_FIFO priority of the loop: above a desktop's threads, below the kernel's watchdogs.
inline constexpr int kLoopPriority = 80;

// Processor time without a sleep, after which the kernel ends a process with a real-time thread
// that hangs: by SIGXCPU, which crash_stop.h catches, and by SIGKILL if that does not act. The
// set-up asks for it.
inline constexpr std::uint64_t kMaxAwakeUs = 2'000'000;
inline constexpr std::uint64_t kMaxAwakeKilledUs = 4'000'000;

// Result of each part of the set-up: 0, or errno of the system call.
struct RealtimeOutcome {
  int priority = 0;  // requested
  int priority_error = 0;
  int lock_error = 0;
  int affinity_core = -1;  // requested; -1: none
  int affinity_error = 0;
};

// How the set-up of the loop went, in words for the window and the sidecar.
struct RealtimeStatus {
  bool fifo_priority = false;
  bool memory_locked = false;
  bool affinity_set = false;
  std::string text;  // one line: "real-time priority 80, memory locked, core 1", or what is missing
  std::string advice;  // what to do about it; empty if nothing is to be done
};

// The outcome in words, with advice if something was refused. Realtime-safe: no.
[[nodiscard]] RealtimeStatus describe(const RealtimeOutcome& outcome);

// Refuses a session on a real device without real-time priority, because a late force can hurt a
// hand. Realtime-safe: no.
[[nodiscard]] Failure refuse_without_realtime(const device::DeviceInfo& device,
                                              const RealtimeStatus& status, bool allowed);

// Sets up the calling thread as the real-time loop, as far as the system permits: default
// floating-point environment, touched stack, blocked signals, SCHED_FIFO, memory lock (permanent,
// for the whole process), affinity. The loop also runs without them.
// `affinity_core` -1: left to the scheduler. Realtime-safe: no.
RealtimeOutcome set_up_realtime_thread(int affinity_core);

// Sets up the calling thread to carry a device's reports: just below the loop, as far as the system
// permits. Realtime-safe: no.
void set_up_device_thread();

// Sets up the calling thread to write rows to the disk, with the lowest real-time priority: busy
// cores cost no rows. As far as the system permits. Realtime-safe: no.
void set_up_recorder_thread();

// Sets up the calling thread, and all that it starts, for long computations: they yield to every
// other thread of the session (SCHED_BATCH, nice 10), with the default floating-point environment.
// Realtime-safe: no.
void set_up_background_thread();

// Round to nearest, with denormals, so that every thread computes the same bits. A library built
// with -ffast-math may have switched denormals off for the process. Realtime-safe: no.
void use_default_floating_point();

// Processor time of the calling thread, ns; monotonic. Realtime-safe: yes.
[[nodiscard]] std::int64_t thread_processor_time_ns();

// CLOCK_MONOTONIC with absolute deadlines.
class MonotonicClock : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() override;
  void sleep_until_ns(std::int64_t deadline_ns) override;
};

}  // namespace hapticwall::session
