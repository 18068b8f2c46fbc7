// One pass over the bytes of a recording that checks every row.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/recording/recording_rows.h"
#include "core/result.h"

namespace hapticwall::file {

inline constexpr std::uint64_t kRowsPerBlock = 1024;

// The beginning of kRowsPerBlock rows; the last block may be shorter.
struct RowBlock {
  std::uint64_t offset = 0;  // offset of its first row in the file
  std::uint64_t first_tick = 0;
};

struct ScannedRows {
  CsvColumns columns;
  std::uint64_t rows = 0;  // at least 1
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  std::uint64_t missing_rows = 0;  // number of ticks without a row
  std::uint64_t end_offset = 0;    // end of the last whole row
  bool cut_off = false;            // an incomplete row follows it
  std::optional<double> rate_hz;   // rate from tick and time of the last row
  std::vector<RowBlock> blocks;
};

// Defects tolerated in a partial recording, or in one whose sidecar mentions them.
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
  // Ends the scan, after the last piece.
  [[nodiscard]] Result<ScannedRows> finish();

 private:
  [[nodiscard]] Failure take_line(std::string_view line);
  [[nodiscard]] Failure take_row(std::string_view line);
  [[nodiscard]] Failure check_tick(std::uint64_t tick);
  [[nodiscard]] Error problem(std::string_view text) const;

  std::string origin_;
  Tolerance tolerance_;
  std::string begun_;  // a line without its end
  std::uint64_t line_ = 0;
  Tick tick_;
  ScannedRows rows_;
};

}  // namespace hapticwall::file
