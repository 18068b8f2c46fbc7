// The recorded hand under another algorithm, with its files.
#pragma once

#include <string>

#include "app/command/run_outputs.h"
#include "app/file/recording_reader.h"
#include "app/runtime/hand_rerun.h"
#include "core/result.h"

namespace hapticwall::command {

struct RecordedRerun {
  file::RecordingReader& recording;
  const file::LoadedScene& loaded;  // of runtime::rerun_scene()
  std::string csv;                  // empty: the re-run is not recorded
  bool talks = true;                // progress, and a note where the re-run cannot be exact
};

// Ended early by a stop signal, the CSV is whole for what was run.
[[nodiscard]] Result<runtime::RerunOutcome> rerun_recorded(const RecordedRerun& rerun,
                                                           RunOutputs& outputs);

// "the recording again, bit for bit", or where and how far it leaves it; a line like those of the
// summary.
[[nodiscard]] std::string comparison_line(const runtime::RerunOutcome& outcome, double rate_hz);

}  // namespace hapticwall::command
