// The window: opens on a scene, runs until it is closed.
#pragma once

#include <string>

#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::ui {

struct WindowOptions {
  Scene scene;
  std::string recording_folder;  // where the record button puts its files; empty: the current one
};

// Returns when the user closes the window or the process is asked to end (SIGINT, SIGTERM).
[[nodiscard]] Failure run_window(const WindowOptions& options);

}  // namespace hapticwall::ui
