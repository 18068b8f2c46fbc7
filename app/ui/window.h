// The window: opens on a scene, runs until it is closed.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/runtime/session.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::ui {

struct WindowOptions {
  Scene scene;
  // Starts a session on a device; empty: the simulator.
  std::function<Result<std::unique_ptr<runtime::Session>>(const Scene&)> start_on_device;
  std::string recording_folder;  // where the record button puts its files; empty: the current one
};

// Returns when the user closes the window or the process is asked to end (SIGINT, SIGTERM).
[[nodiscard]] Failure run_window(const WindowOptions& options);

}  // namespace hapticwall::ui
