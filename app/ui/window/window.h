// The window: opens on a scene, runs until it is closed.
#pragma once

#include <functional>

#include "app/session/window_options.h"
#include "core/result.h"

namespace hapticwall::ui {

class Application;

// The name of the program on a desktop, in reverse-DNS form: class of the window on X11,
// application id on Wayland, and name of the files in assets/desktop. It names no website.
inline constexpr const char* kApplicationId = "org.hapticwall.hapticwall";

// Hooks for tests and benchmarks. Called on the window's thread with its contexts current; any may
// be empty.
struct WindowHooks {
  std::function<void(Application&)> opened;  // before the first frame
  std::function<void()> drawn;               // after every frame
  std::function<void()> closed;              // after the last one; the application still lives
  // N > 0: no wait between frames, and only every Nth is painted.
  int painted_of = 0;
};

// Returns when the user closes the window or the process is asked to end (SIGINT, SIGTERM).
[[nodiscard]] Failure run_window(const session::WindowOptions& options,
                                 const WindowHooks& hooks = {});

// Idle detection: no samples arrive and the user does nothing.
inline constexpr double kAwakeS = 0.6;  // time awake after the last event
inline constexpr double kFrameS = 1.0 / 60.0;
inline constexpr double kIdleFrameS = 1.0;  // events end the wait early

class Idleness {
 public:
  // An event at `now_s`, on any monotonic clock.
  void wake(double now_s) { awake_until_s_ = now_s + kAwakeS; }
  [[nodiscard]] bool idle(double now_s) const { return now_s >= awake_until_s_; }
  // Interval between the starts of two frames.
  [[nodiscard]] double frame_s(double now_s) const { return idle(now_s) ? kIdleFrameS : kFrameS; }

 private:
  double awake_until_s_ = kAwakeS;
};

}  // namespace hapticwall::ui
