// Runs the recorded hand under another algorithm, and writes the files.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/command/run/run_outputs.h"
#include "app/file/recording/recording_reader.h"
#include "app/runtime/session/hand_rerun.h"
#include "core/algorithm/algorithm.h"
#include "core/result.h"

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

// A line of the summary: equal to the recording bit for bit, or the first tick and size of the
// difference.
[[nodiscard]] std::string comparison_line(const runtime::RerunOutcome& outcome, double rate_hz);

}  // namespace hapticwall::command
