#include "app/emulator/realtime.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include "app/runtime/realtime_setup.h"

namespace hapticwall::emulator {

static_assert(kDevicePriority > runtime::kLoopPriority);

std::string set_up_realtime() {
  runtime::use_default_floating_point();
  // The kernel moves a process's pages together into huge ones, and whoever touches them meanwhile
  // waits for milliseconds, whatever his priority.
  prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0);
  sched_param parameters{};
  parameters.sched_priority = kDevicePriority;
  const bool fifo = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
  const bool locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  return fmt::format(
      "{}, {}",
      fifo ? fmt::format("real-time priority {}", kDevicePriority) : "no real-time priority",
      locked ? "memory locked" : "memory not locked");
}

}  // namespace hapticwall::emulator
