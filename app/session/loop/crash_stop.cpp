#include "app/session/loop/crash_stop.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <ctime>
#include <memory>
#include <mutex>
#include <utility>

#include "app/session/loop/early_exit.h"
#include "core/algorithm/plugin/library_call.h"

namespace hapticwall::session {
namespace {

// Faults; sanitizers may have handlers for them.
constexpr std::array kFaults{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr std::array kSignals{SIGSEGV, SIGBUS,  SIGFPE, SIGILL,  SIGABRT,
                              SIGHUP,  SIGQUIT, SIGINT, SIGTERM, SIGXCPU};
constexpr std::int64_t kWaitStepNs = 200'000;
// Limit of a last call into a library. The call ends the process, and may wait for a mutex of the
// library.
constexpr unsigned kMaxReentryS = 1;
// Larger than any signal frame; the handler itself needs little.
constexpr std::size_t kMinStackBytes = std::size_t{64} * 1024;

// The only data that the signal handler uses.
std::atomic<bool> g_must_end{false};
std::atomic<int> g_loops_with_force{0};
// The loop of this thread, if it has one.
struct OwnLoop {
  void (*remove_force)(void* loop) noexcept = nullptr;
  void* loop = nullptr;
};
constinit thread_local OwnLoop t_own_loop;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

// The previous handler of each caught signal. Written before the signal is caught.
struct Caught {
  struct sigaction before {};
  bool here = false;
};
std::array<Caught, kSignals.size()> g_caught;

std::mutex g_mutex;  // protects g_crash_stops and writes of g_caught
int g_crash_stops = 0;

bool is_fault(int signal) {
  return std::find(kFaults.begin(), kFaults.end(), signal) != kFaults.end();
}

void put_back(int signal) {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    if (kSignals[i] == signal) sigaction(signal, &g_caught[i].before, nullptr);
  }
}

// A fault happens again when this returns, and then meets the previous handler. A signal that was
// sent, by a process (si_code 0 and below) or by the kernel for a terminal or a limit, does not
// happen again: raise it, pending until this returns.
extern "C" void hapticwall_on_crash(int signal, siginfo_t* info, void* /*context*/) {
  const int error = errno;
  end_all_force();
  put_back(signal);
  const bool happens_again = is_fault(signal) && info->si_code > 0;
  if (!happens_again) static_cast<void>(raise(signal));
  errno = error;
}

bool is_ours(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) != 0 && action.sa_sigaction == hapticwall_on_crash;
}

bool is_ours_to_catch(int signal, const struct sigaction& present) {
  return present.sa_handler == SIG_DFL || is_fault(signal);
}

void catch_signals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    Caught& caught = g_caught[i];
    sigaction(kSignals[i], nullptr, &caught.before);
    caught.here = is_ours_to_catch(kSignals[i], caught.before);
    if (!caught.here) continue;
    struct sigaction ours {};
    ours.sa_sigaction = hapticwall_on_crash;
    ours.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigfillset(&ours.sa_mask);  // Blocks all signals in the handler: the process ends only once.
    sigaction(kSignals[i], &ours, nullptr);
  }
}

// Keeps handlers that were installed since.
void release_signals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    struct sigaction present {};
    sigaction(kSignals[i], nullptr, &present);
    if (g_caught[i].here && is_ours(present)) sigaction(kSignals[i], &g_caught[i].before, nullptr);
    g_caught[i].here = false;
  }
}

// A thread's signal stack for its lifetime.
class SignalStack {
 public:
  SignalStack() {
    stack_t present{};
    if (sigaltstack(nullptr, &present) != 0 || (present.ss_flags & SS_DISABLE) == 0) return;
    const auto wanted = static_cast<std::size_t>(std::max(0L, sysconf(_SC_SIGSTKSZ)));
    const std::size_t bytes = std::max(kMinStackBytes, wanted);
    memory_ = std::make_unique<std::byte[]>(bytes);
    stack_t own{};
    own.ss_sp = memory_.get();
    own.ss_size = bytes;
    sigaltstack(&own, nullptr);
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;
  ~SignalStack() {
    stack_t present{};
    if (!memory_ || sigaltstack(nullptr, &present) != 0 || present.ss_sp != memory_.get()) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
  }

 private:
  std::unique_ptr<std::byte[]> memory_;
};

}  // namespace

CrashStop::CrashStop() {
  static const bool kWatched = (watch_exit(), true);
  static_cast<void>(kWatched);
  thread_local const SignalStack kStack;
  static_cast<void>(kStack);
  const std::lock_guard lock(g_mutex);
  if (g_crash_stops++ == 0) catch_signals();
}

CrashStop::~CrashStop() {
  const std::lock_guard lock(g_mutex);
  if (--g_crash_stops == 0) release_signals();
}

LoopWithForce::LoopWithForce(void (*remove_force)(void* loop) noexcept, void* loop) noexcept {
  t_own_loop = {remove_force, loop};
  g_loops_with_force.fetch_add(1, std::memory_order_relaxed);
}

LoopWithForce::~LoopWithForce() {
  t_own_loop = {};
  g_loops_with_force.fetch_sub(1, std::memory_order_release);
}

bool must_end_force() noexcept { return g_must_end.load(std::memory_order_relaxed); }

void end_all_force() noexcept {
  g_must_end.store(true, std::memory_order_release);
  // Removes the own loop's force before the wait: the link's threads need that time to send the
  // zero.
  const OwnLoop own = std::exchange(t_own_loop, {});
  if (own.remove_force != nullptr) own.remove_force(own.loop);
  const LibraryCall* const call = present_library_call();
  if (call != nullptr && call->remove_force != nullptr) {
    alarm(kMaxReentryS);
    call->remove_force(call->owner);
  }
  constexpr auto kSteps = static_cast<int>(kMaxLastWaitNs / kWaitStepNs);
  for (int i = 0; i < kSteps && g_loops_with_force.load(std::memory_order_acquire) > 0; ++i) {
    const timespec pause{0, static_cast<decltype(timespec::tv_nsec)>(kWaitStepNs)};
    nanosleep(&pause, nullptr);
  }
}

void end_by(int signal) noexcept {
  end_all_force();
  std::signal(signal, SIG_DFL);
  static_cast<void>(raise(signal));
}

}  // namespace hapticwall::session
