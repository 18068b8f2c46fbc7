// The files of one run. They are opened before it starts, and get their names when it succeeds.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/command/report/output_file.h"
#include "app/file/picture.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/scene/scene_file.h"
#include "core/simulation/simulate.h"

namespace hapticwall::command {

class RunOutputs {
 public:
  // Opens the files that `options` name, without the CSV if `session_records`.
  [[nodiscard]] static Result<RunOutputs> open(const OutputOptions& options,
                                               const file::LoadedScene& loaded,
                                               bool session_records);

  // Whether take() must be called with every tick.
  [[nodiscard]] bool wants_ticks() const { return recording_ || files_.wants_plot(); }
  void take(const Tick& tick);
  // A file could not be written: the run should end.
  [[nodiscard]] const Failure& failure() const { return failure_; }

  // Finishes the recording, also of a run that ended early.
  [[nodiscard]] Failure finish_recording(const file::LoadedScene& loaded, std::uint64_t ticks);
  // Writes JSON and figure, and prints JSON or `table`.
  [[nodiscard]] Failure finish(const Scene& scene, const RunSummary& summary, std::string table);

 private:
  [[nodiscard]] Result<file::Picture> draw(const Scene& scene) const;

  std::unique_ptr<file::RecordingWriter> recording_;
  std::uint64_t first_recorded_tick_ = 0;
  OutputFiles files_;
  std::array<std::vector<Sample>, kMaxAxes> samples_;  // of the figure, by axis
  Failure failure_;
};

}  // namespace hapticwall::command
