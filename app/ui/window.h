// The window: opens on a scene, runs until it is closed.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/runtime/session.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::ui {

struct WindowOptions {
  Scene scene;
  // Starts a session on a device; empty: the simulator.
  std::function<Result<std::unique_ptr<runtime::Session>>(const Scene&)> start_on_device;
  // What is shown at first, a replay perhaps; empty: a session of the scene.
  std::function<Result<std::unique_ptr<runtime::Session>>()> first;
  // Where the record button puts its files; empty: as the settings say, or the current folder.
  std::string recording_folder;
  std::string settings_path;          // empty: settings are neither read nor kept
  std::optional<float> forced_scale;  // of everything; empty: as the settings or the screen say
  double spin_s = 0.0;                // as SessionOptions::spin_s, on the simulator
  std::string opened_file;            // that the scene came from; empty: it is built in
};

class Application;

// For whoever uses the window in place of a person. Called on the window's thread, with its
// contexts current; any may be empty.
struct WindowHooks {
  std::function<void(Application&)> opened;  // before the first frame
  std::function<void()> drawn;               // after every frame
  std::function<void()> closed;              // after the last one; the application still lives
  bool in_a_hurry = false;                   // no rest between frames, and few of them are painted
};

// Returns when the user closes the window or the process is asked to end (SIGINT, SIGTERM).
[[nodiscard]] Failure run_window(const WindowOptions& options, const WindowHooks& hooks = {});

}  // namespace hapticwall::ui
