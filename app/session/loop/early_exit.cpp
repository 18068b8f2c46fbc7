#include "app/session/loop/early_exit.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "app/file/text/text.h"
#include "app/session/loop/crash_stop.h"
#include "core/algorithm/plugin/library_call.h"
#include "core/result.h"

namespace hapticwall::session {
namespace {

std::atomic<bool> g_is_error{false};
std::atomic<bool> g_ends{false};
std::atomic<int> g_status{0};  // exit status of the error
static_assert(std::atomic<int>::is_always_lock_free);

void leave(int /*signal*/) { _exit(g_status.load()); }

// `call`: of the thread that called exit(); nullptr: a library of which nothing is known.
void say_who_did_it(const LibraryCall* call) {
  const std::string who =
      call == nullptr ? "a library" : file::shown(call->library) + ": its " + call->function;
  const std::string line =
      "error: " + who + " called exit(), where it has to return: the force is off, and there is " +
      "no result\n";
  std::fputs(line.c_str(), stderr);
}

void on_exit() {
  const LibraryCall* const call = present_library_call();
  const bool is_error = g_is_error.load();
  if (is_error && g_ends.exchange(true)) {
    while (true) pause();  // another thread is about to end the process
  }
  g_status = static_cast<int>(call == nullptr ? ErrorKind::kUsage : call->kind);
  if (is_error) std::signal(SIGALRM, leave);  // for the alarm of end_all_force()
  end_all_force();
  if (!is_error) return;
  say_who_did_it(call);
  leave(0);
}

}  // namespace

void watch_exit() {
  static_cast<void>(std::atexit(on_exit));
  static_cast<void>(std::at_quick_exit(on_exit));
}

EarlyExitIsAnError::EarlyExitIsAnError() {
  watch_exit();
  g_is_error = true;
}

EarlyExitIsAnError::~EarlyExitIsAnError() { g_is_error = false; }

}  // namespace hapticwall::session
