// Parts of the machine under the window. The window hides every control that needs a missing one.
#pragma once

namespace hapticwall::ui {

// A desktop has all of it, a page in a browser nothing.
struct Capabilities {
  bool files = true;     // recordings, exports, scenes and devices in files
  bool devices = true;   // a real device may be attached
  bool timing = true;    // a clock that times single ticks
  bool threads = true;   // long computations beside the window
  bool sound = true;     // a sound card may be opened
  bool all_keys = true;  // false: F5 and the zoom with Ctrl belong to the program around the window
};

// The part that a row of a table needs; nullptr: none.
using Needs = bool Capabilities::*;

[[nodiscard]] inline bool has(const Capabilities& can, Needs needs) {
  return needs == nullptr || can.*needs;
}

}  // namespace hapticwall::ui
