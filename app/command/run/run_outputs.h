// The files of one run: all are opened before it starts, all get their names when they are whole.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/command/common_options.h"
#include "app/command/output_file.h"
#include "app/file/picture.h"
#include "app/file/recording_writer.h"
#include "app/file/scene_file.h"
#include "core/simulate.h"

namespace hapticwall::command {

// A figure keeps the samples of all its runs in memory.
inline constexpr std::uint64_t kMostPlottedTicks = 1'000'000;

class RunOutputs {
 public:
  // Opens what `options` name. `session_records`: the CSV is the live session's business.
  [[nodiscard]] static Result<RunOutputs> open(const OutputOptions& options,
                                               const file::LoadedScene& loaded,
                                               bool session_records);

  // Whether anything wants samples; take() is called for every one of them then.
  [[nodiscard]] bool wants_samples() const { return recording_ || plot_.is_open(); }
  // `y`: of the second axis, where the scene has one.
  void take(const Sample& x, const Sample& y);
  // A file could not be written: the run may as well end.
  [[nodiscard]] const Failure& failure() const { return failure_; }

  // The recording alone: it is whole for what was run, also when that ended early.
  [[nodiscard]] Failure finish_recording(const file::LoadedScene& loaded, std::uint64_t ticks);
  // The summary as JSON and the figure.
  [[nodiscard]] Failure finish(const Scene& scene, const Summary& summary);

 private:
  [[nodiscard]] Result<file::Picture> draw(const Scene& scene) const;

  std::unique_ptr<file::RecordingWriter> recording_;
  std::uint64_t first_recorded_tick_ = 0;
  OutputFile json_;
  OutputFile plot_;
  std::vector<Sample> samples_;    // of the figure
  std::vector<Sample> y_samples_;  // the same of a second axis
  bool second_axis_ = false;
  Failure failure_;
};

}  // namespace hapticwall::command
