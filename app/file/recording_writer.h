// A recording: one CSV row a tick, and a sidecar that says everything needed to repeat it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/file/mark.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::file {

// The columns after those that every recording has: what only a simulator knows, or what only a
// real device's link does.
// Where a scene has a second axis all columns but tick and time follow once more, with the prefix
// y_.
enum class MoreColumns : std::uint8_t { kSimulator, kDevice, kSimulatorTwoAxes, kDeviceTwoAxes };

[[nodiscard]] constexpr MoreColumns more_columns(bool simulated, bool second_axis) {
  if (second_axis) return simulated ? MoreColumns::kSimulatorTwoAxes : MoreColumns::kDeviceTwoAxes;
  return simulated ? MoreColumns::kSimulator : MoreColumns::kDevice;
}
[[nodiscard]] constexpr bool of_simulator(MoreColumns columns) {
  return columns == MoreColumns::kSimulator || columns == MoreColumns::kSimulatorTwoAxes;
}
[[nodiscard]] constexpr bool has_second_axis(MoreColumns columns) {
  return columns == MoreColumns::kSimulatorTwoAxes || columns == MoreColumns::kDeviceTwoAxes;
}

// No row that the writer writes is longer.
inline constexpr std::size_t kLongestCsvLine = 1024;  // bytes, without the line end

// The CSV header line without its line end.
[[nodiscard]] std::string csv_header(MoreColumns columns);

// Appends one row with its line end to `text`; numbers in the shortest form that reads back to the
// same double, whatever the locale. `y`: the same tick's sample of the second axis; looked at where
// the columns have one.
void append_csv_row(std::string& text, const Sample& sample, MoreColumns columns,
                    const Sample& y = {});

// Whether every number of the sample, simulator's and device's included, is finite.
[[nodiscard]] bool is_finite(const Sample& sample);

// A change of parameters during a session: in force from `tick` on. The scene as it was from then.
struct RecordedChange {
  std::uint64_t tick = 0;
  Scene scene;
};

// What the sidecar says beside the scene.
struct RecordingMetadata {
  std::string
      start_time;      // UTC, ISO 8601; empty for a headless run (identical runs, identical files)
  std::string device;  // for people: "simulator"
  std::string realtime_status;  // in words
  std::uint64_t first_tick = 0;
  std::uint64_t dropped_rows = 0;
  // How many ticks the session had, so that a repetition has as many; absent: up to the last row.
  std::optional<std::uint64_t> session_ticks;
  bool recovered = false;  // finished by recover_recording(), after the session had been cut off
  bool repeatable = true;  // false where the hand followed the pointer
  std::string not_repeatable_because;
  std::vector<RecordedChange> changes;  // since tick 0, in order
  std::vector<Mark> marks;              // in order, at most kMostMarks
};

// Writes NAME.csv.partial while it grows; finish() gives CSV and sidecar NAME.toml their names.
// Destroyed without finish(), the final name is never taken; the partial files stay where there are
// rows, and recover_recording() finishes them. Realtime-safe: no; used by one thread at a time.
class RecordingWriter {
 public:
  // `csv_path` should end in ".csv"; the sidecar replaces the ending by ".toml" (or adds it).
  // Refuses what cannot be written, a sidecar that would replace a file which is not a recording's,
  // and a NAME.csv.partial that recover_recording() could finish.
  [[nodiscard]] static Result<std::unique_ptr<RecordingWriter>> create(const std::string& csv_path,
                                                                       MoreColumns columns);
  virtual ~RecordingWriter() = default;

  // Puts into NAME.toml.partial what is known by now, so that a recording that is cut off can be
  // finished: at the start, and again when something has changed.
  virtual Failure note(const Scene& scene, const RecordingMetadata& metadata) = 0;
  // Buffers; fails (exit status 4) when the disk does, and then again at every later call. A sample
  // that is not finite gets no row; where finite ones follow, the recording counts as incomplete.
  // `y`: of the second axis, where the columns have one.
  virtual Failure append(const Sample& sample, const Sample& y) = 0;
  Failure append(const Sample& sample) { return append(sample, Sample{}); }
  // Hands everything buffered to the operating system.
  virtual Failure flush() = 0;
  // `scene`: as it was at tick 0.
  virtual Failure finish(const Scene& scene, const RecordingMetadata& metadata) = 0;
  [[nodiscard]] virtual std::uint64_t rows() const = 0;
  [[nodiscard]] virtual const std::string& csv_path() const = 0;
  [[nodiscard]] virtual const std::string& sidecar_path() const = 0;
};

}  // namespace hapticwall::file
