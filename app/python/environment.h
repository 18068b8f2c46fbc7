// Environments that Python brings: functions by their address, and plug-ins by their file.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/python/law.h"

namespace hapticwall::python {

// Functions are addresses as in hw_environment; 0: none.
struct OwnEnvironment : OwnPart {
  std::uintptr_t configure = 0;
  std::uintptr_t reset = 0;
  std::uintptr_t force = 0;
  std::uintptr_t advance = 0;
  std::uintptr_t depth = 0;
  std::uintptr_t stiffness_hint = 0;
};

// Max environments of different names in a process. One under the name of an earlier one takes its
// place.
inline constexpr std::size_t kMaxOwnEnvironments = 16;

// Puts it into the list of environments and gives its index. Raises ValueError for what a plug-in
// must not be, for another one's name with other parameters or functions, and RuntimeError during a
// run.
std::size_t add_environment(const OwnEnvironment& environment);

// True if the environment's force() takes the interpreter's lock.
[[nodiscard]] bool environment_takes_lock(std::size_t environment);

void bind_environments(nanobind::module_& m);

}  // namespace hapticwall::python
