// The end of the display server. Xlib would call exit() then, in the middle of a frame.
#pragma once

#include "core/result.h"

namespace hapticwall::ui {

class Application;

// While this lives, a lost connection to the X server ends the process: every loop with zero force,
// then the application's recording, with exit status 5 and one line on standard error. So does a
// request that the server refuses, which Xlib does not survive either. Construct it after the
// window: GLFW 3.3 takes back the handlers when it opens one.
class DisplayEnd {
 public:
  explicit DisplayEnd(Application& application);
  DisplayEnd(const DisplayEnd&) = delete;
  DisplayEnd& operator=(const DisplayEnd&) = delete;
  ~DisplayEnd();
};

// Loss of a Wayland compositor. GLFW only closes the window, so this distinguishes it from the
// user's close.
[[nodiscard]] Failure lost_compositor();

}  // namespace hapticwall::ui
