// A recording that is read: every row checked once, then any stretch of it at any time.
//
// The rows stay in the file; memory holds where every thousandth of them is. An hour at 1 kHz has
// 3.6 million.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/file/recording_scan.h"
#include "app/file/scene_file.h"
#include "core/result.h"
#include "core/sample.h"

namespace hapticwall::file {

// What is known of a recording besides its rows.
struct RecordingInfo {
  std::string csv_path;
  ScannedRows scanned;
  double rate_hz = 1000.0;  // the sidecar's; without one as the last row's time tells it, else 1000

  // Of the sidecar. Without one `loaded` is a scene without walls and hand, and the rest is empty.
  bool has_sidecar = false;
  std::string sidecar_problem;  // why there is none, where a file is there
  LoadedScene loaded;
  std::string device;
  std::string realtime;    // how the real-time set-up went, in words
  std::string start_time;  // UTC

  // What a person should know before believing what is shown; a line each.
  std::vector<std::string> notes;

  [[nodiscard]] bool of_simulator() const { return file::of_simulator(scanned.columns); }
};

// How the first pass goes on: told a fraction from 0 to 1 now and then; false ends it.
using ReadProgress = std::function<bool(double fraction)>;

// Realtime-safe: no; used by one thread at a time.
class RecordingReader {
 public:
  // NAME.csv with NAME.toml beside it, or NAME.csv.partial with NAME.toml.partial. Reads all of
  // it once. An error (exit status 2) where anything in it is wrong: "NAME.csv:12: force_n: 'x' is
  // no finite number", and where `progress` ended it. Only a note: no sidecar or a wrong one, a CSV
  // that is not the one its sidecar was written for, holes that the sidecar tells of, and the
  // cut-off last line of a partial file.
  [[nodiscard]] static Result<std::unique_ptr<RecordingReader>> open(
      const std::string& csv_path, const ReadProgress& progress = {});

  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;
  ~RecordingReader();

  [[nodiscard]] const RecordingInfo& info() const { return info_; }
  [[nodiscard]] std::uint64_t rows() const { return info_.scanned.rows; }

  // The rows from `first_row` on, up to out.size() of them; returns how many, 0 behind the last.
  // A sample's `generation` counts the parameter changes up to its tick. Fails (exit status 2)
  // where the file is no longer what it was.
  // `y`: as many places for the same rows of the second axis, or none; all zero but tick and time
  // where the recording has one axis.
  [[nodiscard]] Result<std::size_t> read(std::uint64_t first_row, std::span<Sample> out,
                                         std::span<Sample> y = {});

  // The first row of `tick` or later; rows() behind the last. Fails as read() does.
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
  std::string claimed_sha256_;

  static constexpr std::uint64_t kNoBlock = ~std::uint64_t{0};
  std::uint64_t loaded_block_ = kNoBlock;
  std::vector<Sample> samples_;    // of the loaded block
  std::vector<Sample> y_samples_;  // the same rows of the second axis
  std::string text_;
};

}  // namespace hapticwall::file
