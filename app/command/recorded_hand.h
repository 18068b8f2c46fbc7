// A recording as the SCENE of a command on the simulator: its recorded hand is re-run.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "app/command/common_options.h"
#include "app/command/report/progress.h"
#include "app/file/recording/recording_reader.h"
#include "app/session/hand_rerun.h"
#include "core/algorithm/algorithm.h"
#include "core/result.h"

namespace hapticwall::command {

struct OpenedRecording {
  std::unique_ptr<file::RecordingReader> reader;
  file::LoadedScene loaded;  // of session::rerun_scene()
};

// Opens options.scene. `talks`: prints on standard error that the recording's hand is re-run. Fails
// where rerun_scene() does, and with --duration.
[[nodiscard]] Result<OpenedRecording> open_for_rerun(const SceneOptions& options, bool talks);

// One row of a comparison: rerun_hand() with this algorithm; nullopt if a signal ended it.
[[nodiscard]] Result<std::optional<Summary>> rerun_row(
    OpenedRecording& recording, const ComparedAlgorithm& row,
    const std::function<void(const Tick&)>& on_tick, Progress& progress);

// Prints on standard error what the re-run leaves out.
void tell_limits(const file::RecordingInfo& recording);

}  // namespace hapticwall::command
