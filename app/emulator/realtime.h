// What the emulator asks of the operating system to keep its tick.
#pragma once

#include <string>

namespace hapticwall::emulator {

// SCHED_FIFO priority: a device does not wait for the loop that drives it.
inline constexpr int kDevicePriority = 81;

// Asks for priority and locked memory, and says in words what was granted. Nothing of it is needed
// to run.
[[nodiscard]] std::string set_up_realtime();

}  // namespace hapticwall::emulator
