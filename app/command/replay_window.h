// The window with a recording.
#pragma once

#include <memory>
#include <optional>

#include "app/file/recording/recording_reader.h"
#include "app/session/replay_session.h"
#include "app/session/window_options.h"

namespace hapticwall::command {

struct ReplayWindow {
  double speed = 1.0;
  std::optional<session::Overlay> overlay;
  std::optional<float> scale;  // nullopt: from the settings or the screen
};

// Returns when the window is closed. Leaving the replay opens the recording's scene, or the default
// one if it has none.
[[nodiscard]] Failure run_replay_window(std::unique_ptr<file::RecordingReader> recording,
                                        ReplayWindow window, const session::OpenWindow& open);

}  // namespace hapticwall::command
