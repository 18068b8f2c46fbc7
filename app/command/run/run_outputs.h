// The files of one run. They are opened before it starts, and get their names when it succeeds.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/command/output_file.h"
#include "app/file/picture.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/recording/sample_stream.h"
#include "app/file/scene/scene_file.h"
#include "app/sound/signal/sound_stream.h"
#include "core/run/simulate.h"

namespace hapticwall::command {

// Max length of a sound file, because its samples are kept in memory.
inline constexpr double kMaxSoundS = 600.0;

// Source of the ticks of a run.
struct TickOrigin {
  bool session_records = false;  // a session writes the CSV
  bool in_real_time = false;     // true: a session streams; false: a headless run
  file::CsvColumns columns;
};

class RunOutputs {
 public:
  // Opens the files that `options` name, without the CSV if the session records.
  [[nodiscard]] static Result<RunOutputs> open(const OutputOptions& options,
                                               const file::LoadedScene& loaded,
                                               const TickOrigin& origin);

  // Null without --stream.
  [[nodiscard]] const std::shared_ptr<file::SampleStream>& stream() const { return stream_; }

  [[nodiscard]] const file::CsvColumns& columns() const { return columns_; }

  // True if take() must be called with every tick.
  [[nodiscard]] bool wants_ticks() const {
    return recording_ || files_.wants_plot() || sound_ || feed_;
  }
  void take(const Tick& tick);
  // Failure of the recording. The run continues for its other outputs, and finish() fails.
  [[nodiscard]] const Failure& failure() const { return failure_; }
  void keep_failure(Failure failure) { failure_ = std::move(failure); }

  // Writes what is buffered for the stream. Returns true if the stream is the only output and its
  // reader has left: the run may end.
  [[nodiscard]] bool reader_left() const;

  // Finishes the recording, also of a run that ended early.
  void finish_recording(const file::LoadedScene& loaded, std::uint64_t ticks,
                        const RunSummary& summary);
  // Ends the stream; returns the samples that were lost, nullopt without --stream.
  [[nodiscard]] std::optional<std::uint64_t> end_stream();
  // Calls end_stream(), writes JSON, figure and sound, and prints JSON or `table`. Returns the
  // first failure, that of the recording included.
  [[nodiscard]] Failure finish(const Scene& scene, const RunSummary& summary, std::string table);

 private:
  [[nodiscard]] Result<file::Picture> draw(const Scene& scene, const draw::Paper& paper) const;
  [[nodiscard]] Failure open_stream(const OutputOptions& options, const TickOrigin& origin);
  [[nodiscard]] Failure write_sound();

  file::CsvColumns columns_;
  std::unique_ptr<file::RecordingWriter> recording_;
  std::uint64_t first_recorded_tick_ = 0;
  OutputFiles files_;
  std::shared_ptr<file::SampleStream> stream_;
  bool only_streams_ = false;                          // the stream is the only output
  std::optional<file::StreamFeed> feed_;               // only if the run is not in real time
  std::array<std::vector<Sample>, kMaxAxes> samples_;  // samples of the figure, by axis
  std::optional<sound::SoundStream> sound_;
  std::vector<float> heard_;
  OutputFile wav_;
  Failure failure_;
};

}  // namespace hapticwall::command
