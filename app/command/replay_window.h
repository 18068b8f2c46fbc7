// The window on a recording.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/file/recording_reader.h"
#include "app/runtime/replay_session.h"

namespace hapticwall::command {

struct ReplayWindow {
  double speed = 1.0;
  std::optional<runtime::Overlay> overlay;
  std::optional<float> scale;  // as of WindowOptions
};

// Returns the exit status, when the window is closed. From there the way back leads to the
// recording's scene, or to the usual one where it has none.
[[nodiscard]] int run_replay_window(std::unique_ptr<file::RecordingReader> recording,
                                    ReplayWindow window);

// The same for a path that was given in the place of a scene.
[[nodiscard]] int run_replay_window(const std::string& csv_path, ReplayWindow window);

}  // namespace hapticwall::command
