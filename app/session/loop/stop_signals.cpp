#include "app/session/loop/stop_signals.h"

#include <sys/time.h>
#include <time.h>  // NOLINT(modernize-deprecated-headers): clock_gettime is not in <ctime>

#include <atomic>
#include <cerrno>

#include "app/session/loop/clock.h"
#include "app/session/loop/crash_stop.h"
#include "app/session/loop/early_exit.h"
#include "core/tick/pulse.h"

namespace hapticwall::session {
namespace {

constexpr decltype(timeval::tv_usec) kLookIntervalUs = 100'000;

// Globals, because signal handlers take no data.
std::atomic<int> g_stop_signal{0};
std::atomic_flag g_looks = ATOMIC_FLAG_INIT;
PulseWatch g_watch;  // watch of the handler that holds g_looks
static_assert(std::atomic<int>::is_always_lock_free);

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * static_cast<std::int64_t>(kNanosecondsPerSecond) + now.tv_nsec;
}

bool something_hangs() {
  if (g_looks.test_and_set(std::memory_order_acquire)) return false;
  const bool hangs = g_watch.finds_silence(now_ns(), kMaxSilenceNs);
  g_looks.clear(std::memory_order_release);
  return hangs;
}

extern "C" void hapticwall_on_look(int /*signal*/) {
  const int error = errno;
  // A dying process that still lives at the next look hangs, too.
  if (something_hangs() || must_end_force()) end_by(stop_signal());
  errno = error;
}

// A timer interrupts no system call of the program for good: SA_RESTART.
void look_from_now_on() {
  struct sigaction look {};
  look.sa_handler = hapticwall_on_look;
  look.sa_flags = SA_RESTART;
  sigaction(SIGALRM, &look, nullptr);
  const itimerval often{{0, kLookIntervalUs}, {0, kLookIntervalUs}};
  setitimer(ITIMER_REAL, &often, nullptr);
}

extern "C" void hapticwall_on_stop_signal(int signal) {
  const int error = errno;
  const int before = g_stop_signal.exchange(signal);
  if (before == signal) end_by(signal);
  if (before == 0) look_from_now_on();
  errno = error;
}

}  // namespace

void catch_stop_signals() {
  watch_exit();
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;  // a background job ignores Ctrl-C
    struct sigaction stop {};
    stop.sa_handler = hapticwall_on_stop_signal;
    sigaction(signal, &stop, nullptr);
  }
}

int stop_signal() { return g_stop_signal.load(); }

StopSignals::StopSignals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], nullptr, &before_[i]);
  g_stop_signal = 0;
  catch_stop_signals();
}

StopSignals::~StopSignals() {
  setitimer(ITIMER_REAL, nullptr, nullptr);
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

}  // namespace hapticwall::session
