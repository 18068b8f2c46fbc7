// Reads a recording: checks every row once, then reads any range of rows at any time.
//
// The rows stay in the file; memory holds the offset of every thousandth. An hour at 1 kHz has
// 3.6 million.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/recording/recording_scan.h"
#include "app/file/scene/scene_file.h"
#include "core/result.h"
#include "core/sample.h"

namespace hapticwall::file {

// Facts about a recording besides its rows.
struct RecordingInfo {
  std::string csv_path;
  ScannedRows scanned;
  double rate_hz = 1000.0;  // from the sidecar, else from the last row, else 1000

  // Content of the sidecar. Without one `loaded` is a scene without walls and hand; the rest is
  // empty.
  bool has_sidecar = false;
  std::string sidecar_problem;  // reason why the file there is no sidecar
  LoadedScene loaded;
  std::string device;
  std::string realtime;    // how the real-time set-up went, in words
  std::string start_time;  // UTC

  // Warnings for the user, one line each.
  std::vector<std::string> notes;

  [[nodiscard]] bool of_simulator() const { return scanned.columns.of_simulator(); }
};

// Progress of the first pass, a fraction from 0 to 1; returning false ends it.
using ReadProgress = std::function<bool(double fraction)>;

// A path that ends with .csv or .csv.partial names a recording; every other path a scene.
[[nodiscard]] bool is_recording(std::string_view path);

// Realtime-safe: no; used by one thread at a time.
class RecordingReader {
 public:
  // Opens NAME.csv with NAME.toml beside it, or NAME.csv.partial with NAME.toml.partial, and reads
  // it once. Fails (exit status 2) at a wrong row ("NAME.csv:12: force_n: 'x' is no finite number")
  // and when `progress` ends it. These are notes, not errors: no sidecar or a wrong one, a CSV that
  // its sidecar was not written for, holes that the sidecar tells of, and the cut-off last line of
  // a partial file.
  [[nodiscard]] static Result<std::unique_ptr<RecordingReader>> open(
      const std::string& csv_path, const ReadProgress& progress = {});

  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;
  ~RecordingReader();

  [[nodiscard]] const RecordingInfo& info() const { return info_; }
  [[nodiscard]] std::uint64_t rows() const { return info_.scanned.rows; }

  // Reads up to out.size() rows from `first_row` on; returns how many, 0 after the last one. A
  // sample's `generation` counts the parameter changes up to its tick. Fails (exit status 2) if the
  // file has changed.
  [[nodiscard]] Result<std::size_t> read(std::uint64_t first_row, std::span<Tick> out);

  // The first row of `tick` or later; rows() after the last. Fails as read() does.
  [[nodiscard]] Result<std::uint64_t> row_at(std::uint64_t tick);

 private:
  explicit RecordingReader(int descriptor) : descriptor_(descriptor) {}
  [[nodiscard]] Failure scan(const ReadProgress& progress);
  void read_sidecar();
  [[nodiscard]] Failure load_block(std::uint64_t block);
  [[nodiscard]] bool parse_block(std::uint64_t wanted_rows);
  void take_over(ScannedRows scanned);
  [[nodiscard]] Error changed() const;
  [[nodiscard]] std::uint32_t generation_at(std::uint64_t tick) const;

  int descriptor_;
  RecordingInfo info_;
  Tolerance tolerance_;

  static constexpr std::uint64_t kNoBlock = ~std::uint64_t{0};
  std::uint64_t loaded_block_ = kNoBlock;
  std::vector<Tick> ticks_;  // ticks of the loaded block
  std::string text_;
};

}  // namespace hapticwall::file
