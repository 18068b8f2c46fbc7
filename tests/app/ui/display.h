// Tells whether there is a display for a window.
#pragma once

#include <cstdlib>

namespace hapticwall::test {

inline bool has_display() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

}  // namespace hapticwall::test
