// The one pass over the bytes of a recording in which every row is checked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/recording_writer.h"
#include "core/result.h"
#include "core/sample.h"

namespace hapticwall::file {

inline constexpr std::uint64_t kRowsPerBlock = 1024;

// Where a stretch of kRowsPerBlock rows begins (the last one may be shorter).
struct RowBlock {
  std::uint64_t offset = 0;  // in the file, of its first row
  std::uint64_t first_tick = 0;
};

struct ScannedRows {
  MoreColumns columns = MoreColumns::kSimulator;
  std::uint64_t rows = 0;  // at least 1
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t missing_rows = 0;  // in holes
  std::uint64_t end_offset = 0;    // behind the last whole row
  bool cut_off = false;            // something that is no whole row stood behind that
  std::optional<double> rate_hz;   // as tick and time of the last row tell it
  std::vector<RowBlock> blocks;
};

// What is forgiven in a file that was never finished, or that says of itself that it has holes.
struct Tolerance {
  bool holes = false;
  bool cut_off = false;
};

// Realtime-safe: no.
class RecordingScan {
 public:
  // `origin`: the file's name for messages ("NAME.csv:12: ...").
  RecordingScan(std::string origin, Tolerance tolerance)
      : origin_(std::move(origin)), tolerance_(tolerance) {}

  // The next piece of the file, of any length, in order. After a failure: nothing more.
  [[nodiscard]] Failure take(std::string_view piece);
  // After the last piece.
  [[nodiscard]] Result<ScannedRows> finish();

 private:
  [[nodiscard]] Failure take_line(std::string_view line);
  [[nodiscard]] Failure take_row(std::string_view line);
  [[nodiscard]] Failure check_tick(std::uint64_t tick);
  [[nodiscard]] Error problem(std::string_view text) const;

  std::string origin_;
  Tolerance tolerance_;
  std::string begun_;  // a line of which the end has not come yet
  std::uint64_t line_ = 0;
  Sample sample_;
  ScannedRows rows_;
};

}  // namespace hapticwall::file
