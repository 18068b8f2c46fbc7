#include "app/command/signals.h"

#include <atomic>
#include <csignal>

#include "app/runtime/crash_stop.h"

namespace hapticwall::command {
namespace {

// Signal handlers know nothing but globals; this one is set once.
std::atomic<int> g_stop_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

// The second one ends the program, force first: whoever sends it has seen that nothing happened.
extern "C" void hapticwall_on_stop_signal(int signal) {
  if (g_stop_signal.exchange(signal) == signal) runtime::end_by(signal);
}

}  // namespace

void ignore_write_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void catch_stop_signals() {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;  // a background job's Ctrl-C is not meant for it
    struct sigaction stop {};
    stop.sa_handler = hapticwall_on_stop_signal;
    sigaction(signal, &stop, nullptr);
  }
}

int stop_signal() { return g_stop_signal.load(); }

std::string_view signal_name(int signal) { return signal == SIGINT ? "Ctrl-C" : "SIGTERM"; }

}  // namespace hapticwall::command
