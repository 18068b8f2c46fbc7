// A recording: one CSV row a tick, and a sidecar that says everything needed to repeat it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/file/recording/recording_rows.h"
#include "app/file/scene/scene_file.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::file {

// The sidecar's content beside the scene.
struct RecordingMetadata {
  // UTC, ISO 8601. Empty for a headless run: identical runs give identical files.
  std::string start_time;
  std::string device;           // for people, such as "simulator"
  std::string realtime_status;  // in words
  std::uint64_t first_tick = 0;
  std::uint64_t dropped_rows = 0;
  // The session's number of ticks, which a repetition runs; nullopt: up to the last row.
  std::optional<std::uint64_t> session_ticks;
  bool recovered = false;  // finished by recover_recording() after the session was cut off
  bool repeatable = true;  // false if the pointer led the hand, for example
  std::string not_repeatable_because;
  std::array<std::optional<std::uint64_t>, kMaxAxes> diverged_at_tick;  // by axis
  std::vector<ScheduledChange> changes;                                 // since tick 0, in order
  std::vector<Mark> marks;  // in order, at most kMaxMarks
};

// When each axis diverged, for the sidecar.
[[nodiscard]] std::array<std::optional<std::uint64_t>, kMaxAxes> divergence_of(
    const RunSummary& summary);

// Metadata of a run on the simulator that was not in real time. `summary`: empty before its end.
[[nodiscard]] RecordingMetadata headless_metadata(const LoadedScene& loaded, std::uint64_t ticks,
                                                  const RunSummary& summary);

// Writes NAME.csv.partial; finish() gives CSV and sidecar NAME.toml their names. Without finish()
// the partial files stay if they have rows, and recover_recording() finishes them. Realtime-safe:
// no; used by one thread at a time.
class RecordingWriter {
 public:
  // `path` should end in ".csv"; the sidecar replaces the ending by ".toml" (or adds it). A link is
  // followed: CSV and sidecar stand beside its target. Fails if the file cannot be written, if the
  // sidecar would replace a file that is not a sidecar, and if recover_recording() could finish a
  // NAME.csv.partial that is there.
  [[nodiscard]] static Result<std::unique_ptr<RecordingWriter>> create(const std::string& path,
                                                                       CsvColumns columns);
  virtual ~RecordingWriter() = default;

  // Writes the present facts to NAME.toml.partial, from which a cut-off recording is recovered. To
  // be called at the start and after every change.
  virtual Failure note(const Scene& scene, const RecordingMetadata& metadata) = 0;
  // Buffers. Fails (exit status 4) when the disk does, and then at every later call. A tick that is
  // not finite gets no row; if finite ones follow, the recording counts as incomplete.
  // Precondition: the tick has as many axes as the columns.
  virtual Failure append(const Tick& tick) = 0;
  // Hands the buffer to the operating system.
  virtual Failure flush() = 0;
  // flush(), and writes to the disk.
  virtual Failure sync() = 0;
  // `scene`: as it was at tick 0.
  virtual Failure finish(const Scene& scene, const RecordingMetadata& metadata) = 0;
  [[nodiscard]] virtual std::uint64_t rows() const = 0;
  [[nodiscard]] virtual const std::string& csv_path() const = 0;
  [[nodiscard]] virtual const std::string& sidecar_path() const = 0;
};

}  // namespace hapticwall::file
