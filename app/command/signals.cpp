#include "app/command/signals.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <csignal>
#include <exception>
#include <new>
#include <system_error>

#include "app/command/report/terminal.h"
#include "app/session/loop/early_exit.h"
#include "core/run/simulate.h"

namespace hapticwall::command {
namespace {

// Checks the stack limit, which is also the stack size of the threads.
Failure check_stack() {
  constexpr rlim_t kMinBytes = rlim_t{1} << 20U;
  constexpr rlim_t kBytesPerKib = 1024;
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kMinBytes) return {};
  return usage_error(
      fmt::format("the stack limit is {} KiB, and the program needs {}: 'ulimit -s 8192' raises it",
                  limit.rlim_cur / kBytesPerKib, kMinBytes / kBytesPerKib));
}

}  // namespace

int run_guarded(const std::function<Result<int>()>& program) {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const session::EarlyExitIsAnError until_it_returns;
  try {
    if (Failure failed = check_stack()) return report(*failed);
    const Result<int> status = program();
    return status ? *status : report(status.error());
  } catch (const SimulationRefused& refused) {
    return report({ErrorKind::kUsage, refused.what()});
  } catch (const std::system_error& error) {
    return report({ErrorKind::kUsage,
                   fmt::format("the system refused a thread or a resource: {}; 'ulimit -a' shows "
                               "the limits",
                               error.what())});
  } catch (const std::bad_alloc&) {
    return report({ErrorKind::kUsage, "out of memory: choose a smaller scene or study"});
  } catch (const std::exception& error) {
    return report({ErrorKind::kUsage, fmt::format("internal error: {}", error.what())});
  }
}

int ended_early(std::string_view rest) {
  tell(fmt::format("ended early by {}{}", stop_signal() == SIGINT ? "Ctrl-C" : "SIGTERM", rest));
  return status_of_signal(stop_signal());
}

Result<int> status_after_window(const Failure& failed) {
  if (failed) return *failed;
  return stop_signal() == 0 ? 0 : ended_early("");
}

}  // namespace hapticwall::command
