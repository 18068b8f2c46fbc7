// Stands for the threads that a browser lacks. All other functions of the sources that are left out
// (Dependencies.cmake) end the page with their name when they are called: Capabilities hide the
// controls that lead there, and ./dev test --web presses the others.
#include <emscripten.h>

#include <cmath>

#include "app/session/loop/crash_stop.h"
#include "app/session/loop/realtime_setup.h"
#include "app/ui/computed/background.h"

namespace hapticwall {

std::launch ui::background_launch() { return std::launch::deferred; }

namespace session {

CrashStop::CrashStop() = default;
CrashStop::~CrashStop() = default;

Failure refuse_without_realtime(const device::DeviceInfo& /*device*/,
                                const RealtimeStatus& /*status*/, bool /*allowed*/) {
  return std::nullopt;  // there is the simulator alone
}

// The only thread stays as it is.
void set_up_background_thread() {}

std::int64_t MonotonicClock::now_ns() { return std::llround(emscripten_get_now() * 1e6); }
// Nobody can wait in a browser: the owner turns the loop when it is due.
void MonotonicClock::sleep_until_ns(std::int64_t /*deadline_ns*/) {}

}  // namespace session
}  // namespace hapticwall
