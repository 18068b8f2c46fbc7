#include "app/session/loop/realtime_setup.h"

#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cfenv>
#include <csignal>
#include <cstddef>
#include <ctime>
#include <system_error>

namespace hapticwall::session {
namespace {

// More than a tick needs; touched once so that no tick takes a page fault.
constexpr std::size_t kStackToTouchBytes = std::size_t{128} * 1024;
constexpr std::size_t kMinPageBytes = 4096;
constexpr int kBackgroundNice = 10;
constexpr std::int64_t kNanosecondsInSecond = 1'000'000'000;

std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNanosecondsInSecond + now.tv_nsec;
}

[[gnu::noinline]] void touch_stack() {
  std::array<std::byte, kStackToTouchBytes> area;
  volatile std::byte* bytes = area.data();
  for (std::size_t i = 0; i < area.size(); i += kMinPageBytes) bytes[i] = std::byte{0};
}

// The main thread handles signals (Ctrl-C); here they would only shorten a sleep.
void block_signals() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

// The highest permitted priority up to kLoopPriority: an unprivileged limit (ulimit -r) may be
// lower.
int permitted_priority() {
  rlimit limit{};
  if (getrlimit(RLIMIT_RTPRIO, &limit) != 0 || limit.rlim_cur == 0) return kLoopPriority;
  return static_cast<int>(std::min<rlim_t>(limit.rlim_cur, kLoopPriority));
}

// Sets the priority of the calling thread; returns 0 or errno.
int set_fifo_priority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
}

// Limits the processor time of each real-time thread of the process. Smaller limits stay.
void limit_processor_time() {
  rlimit limit{};
  if (getrlimit(RLIMIT_RTTIME, &limit) != 0) return;
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, kMaxAwakeKilledUs);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, kMaxAwakeUs);
  static_cast<void>(setrlimit(RLIMIT_RTTIME, &limit));
}

bool may_lock_without_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) return true;
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> data{};
  if (syscall(SYS_capget, &header, data.data()) != 0) return false;
  return (data[CAP_TO_INDEX(CAP_IPC_LOCK)].effective & CAP_TO_MASK(CAP_IPC_LOCK)) != 0;
}

// Under a finite limit, a lock on future pages would make later allocations of the window fail, so
// it is not tried. Pages are locked when touched, because the window does not need all of its
// pages.
int lock_memory() {
  if (!may_lock_without_limit()) return EPERM;
  return mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0 ? 0 : errno;
}

// Disables huge pages: the kernel collects them with lowest priority while it holds the memory map,
// and a page fault in a tick waits for it for milliseconds, even with locked memory.
void keep_small_pages() { prctl(PR_SET_THP_DISABLE, 1UL, 0UL, 0UL, 0UL); }

int set_affinity(int core) {
  if (core < 0 || core >= CPU_SETSIZE) return core == -1 ? 0 : EINVAL;
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  return pthread_setaffinity_np(pthread_self(), sizeof cores, &cores);
}

std::string words_of(int error) { return std::generic_category().message(error); }

std::string priority_words(const RealtimeOutcome& outcome) {
  if (outcome.priority_error == 0) {
    return "real-time priority " + std::to_string(outcome.priority);
  }
  return "no real-time priority (" + words_of(outcome.priority_error) + ")";
}

std::string lock_words(const RealtimeOutcome& outcome) {
  if (outcome.lock_error == 0) return "memory locked";
  return "memory not locked (" + words_of(outcome.lock_error) + ")";
}

std::string affinity_words(const RealtimeOutcome& outcome) {
  if (outcome.affinity_core == -1) return "any core";
  std::string core = "core " + std::to_string(outcome.affinity_core);
  if (outcome.affinity_error == 0) return core;
  return "not on " + core + " (" + words_of(outcome.affinity_error) + ")";
}

std::string advice_words(const RealtimeOutcome& outcome) {
  std::string limits;
  if (outcome.priority_error != 0) limits = "'rtprio " + std::to_string(kLoopPriority) + "'";
  if (outcome.lock_error != 0)
    limits += (limits.empty() ? "" : " and ") + std::string("'memlock unlimited'");
  std::string advice;
  if (!limits.empty()) {
    advice = "allow your user " + limits +
             " in /etc/security/limits.conf and log in again ('ulimit -r -l' shows the limits)";
  }
  if (outcome.affinity_error != 0) {
    advice += (advice.empty() ? "" : "; ") + std::string("choose a core that this process may use");
  }
  return advice;
}

}  // namespace

RealtimeStatus describe(const RealtimeOutcome& outcome) {
  RealtimeStatus status;
  status.fifo_priority = outcome.priority_error == 0;
  status.memory_locked = outcome.lock_error == 0;
  status.affinity_set = outcome.affinity_core != -1 && outcome.affinity_error == 0;
  status.text =
      priority_words(outcome) + ", " + lock_words(outcome) + ", " + affinity_words(outcome);
  status.advice = advice_words(outcome);
  return status;
}

Failure refuse_without_realtime(const device::DeviceInfo& device, const RealtimeStatus& status,
                                bool allowed) {
  if (device.is_simulated || status.fifo_priority || allowed) return std::nullopt;
  return Error{ErrorKind::kDevice, device.name + ": " + status.text + ": " + status.advice +
                                       "; --allow-no-realtime drives the device anyway"};
}

RealtimeOutcome set_up_realtime_thread(int affinity_core) {
  RealtimeOutcome outcome;
  use_default_floating_point();
  block_signals();
  outcome.affinity_core = std::max(affinity_core, -1);
  outcome.affinity_error = set_affinity(outcome.affinity_core);
  keep_small_pages();
  outcome.lock_error = lock_memory();
  touch_stack();
  limit_processor_time();
  outcome.priority = permitted_priority();
  outcome.priority_error = set_fifo_priority(outcome.priority);
  return outcome;
}

void set_up_device_thread() {
  block_signals();
  static_cast<void>(set_fifo_priority(std::max(permitted_priority() - 1, 1)));
}

void set_up_recorder_thread() {
  static_cast<void>(set_fifo_priority(sched_get_priority_min(SCHED_FIFO)));
}

void set_up_background_thread() {
  use_default_floating_point();
  const sched_param none{};
  sched_setscheduler(0, SCHED_BATCH, &none);
  setpriority(PRIO_PROCESS, 0, kBackgroundNice);  // Linux: of the thread
}

void use_default_floating_point() { std::fesetenv(FE_DFL_ENV); }

std::int64_t thread_processor_time_ns() { return clock_ns(CLOCK_THREAD_CPUTIME_ID); }

std::int64_t MonotonicClock::now_ns() { return clock_ns(CLOCK_MONOTONIC); }

void MonotonicClock::sleep_until_ns(std::int64_t deadline_ns) {
  timespec deadline{};
  deadline.tv_sec = static_cast<time_t>(deadline_ns / kNanosecondsInSecond);
  deadline.tv_nsec = static_cast<long>(deadline_ns % kNanosecondsInSecond);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

}  // namespace hapticwall::session
