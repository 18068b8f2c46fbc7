// Runs the recorded hand under another algorithm, and writes the files.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/command/common_options.h"
#include "app/command/report/progress.h"
#include "app/command/run/run_outputs.h"
#include "app/file/recording/recording_reader.h"
#include "app/runtime/session/hand_rerun.h"
#include "core/result.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::command {

struct RecordedRerun {
  file::RecordingReader& recording;
  const file::LoadedScene& loaded;  // of runtime::rerun_scene()
  std::string csv;                  // empty: no recording
  bool talks = true;                // shows progress and notes
};

// After a stop signal, the CSV holds the ticks so far.
[[nodiscard]] Result<runtime::RerunOutcome> rerun_recorded(const RecordedRerun& rerun,
                                                           RunOutputs& outputs);

// A recording as the SCENE of a command on the simulator.
struct OpenedRecording {
  std::unique_ptr<file::RecordingReader> reader;
  file::LoadedScene loaded;  // of runtime::rerun_scene()
};

// Opens options.scene. `talks`: says on standard error that its hand is re-run. Fails where
// rerun_scene() does, and with --duration.
[[nodiscard]] Result<OpenedRecording> open_for_rerun(const SceneOptions& options, bool talks);

// One row of a comparison: rerun_hand() with this algorithm; nullopt if a signal ended it.
[[nodiscard]] Result<std::optional<Summary>> rerun_row(
    OpenedRecording& recording, const ComparedAlgorithm& row,
    const std::function<void(const Tick&)>& on_tick, Progress& progress);

// A line of the summary: equal to the recording bit for bit, or the first tick and size of the
// difference.
[[nodiscard]] std::string comparison_line(const runtime::RerunOutcome& outcome, double rate_hz);

}  // namespace hapticwall::command
