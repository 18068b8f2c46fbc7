// What the session needs of a real-time thread, where a browser has none. All other functions of the
// sources left out (Dependencies.cmake) end the page with their name when they are called: Capabilities
// hide what leads there, and ./dev test --web presses the rest.
#include <emscripten.h>

#include <cmath>

#include "app/session/loop/crash_stop.h"
#include "app/session/loop/realtime_setup.h"

namespace hapticwall::session {

CrashStop::CrashStop() = default;
CrashStop::~CrashStop() = default;

Failure refuse_without_realtime(const device::DeviceInfo& /*device*/,
                                const RealtimeStatus& /*status*/, bool /*allowed*/) {
  return std::nullopt;  // there is the simulator alone
}

// Work without a thread is done on the only one.
void set_up_background_thread() {}

std::int64_t MonotonicClock::now_ns() { return std::llround(emscripten_get_now() * 1e6); }
// Nobody can wait in a browser: the owner turns the loop when it is due.
void MonotonicClock::sleep_until_ns(std::int64_t /*deadline_ns*/) {}

}  // namespace hapticwall::session
