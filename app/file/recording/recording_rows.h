// The lines of a recording's CSV: its columns, its header and its rows, written and read back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"
#include "core/sample.h"

namespace hapticwall::file {

// The columns of a recording. Those of axis y follow those of axis x and have the prefix y_.
struct CsvColumns {
  ColumnGroup source = ColumnGroup::kTruth;  // or kDevice
  std::uint8_t axes = 1;
  bool applied = false;  // with kApplied: older recordings of devices have none

  [[nodiscard]] bool of_simulator() const { return source == ColumnGroup::kTruth; }
  friend bool operator==(const CsvColumns&, const CsvColumns&) = default;
};

[[nodiscard]] constexpr CsvColumns csv_columns(bool simulated, std::size_t axes = 1) {
  return {simulated ? ColumnGroup::kTruth : ColumnGroup::kDevice, static_cast<std::uint8_t>(axes),
          !simulated};
}

// Upper limit of a line in bytes, without its line end.
inline constexpr std::size_t kMaxCsvLineBytes = 1024;

// The header line without its line end.
[[nodiscard]] std::string csv_header(CsvColumns columns);
// The columns that a header line (without its end) names. The error has no place yet: the caller
// puts "NAME.csv:1: " in front of it.
[[nodiscard]] Result<CsvColumns> parse_csv_header(std::string_view line);

// Appends one row with its line end. Numbers have the shortest form that reads back to the same
// double, in every locale. Precondition: the tick has as many axes as the columns.
void append_csv_row(std::string& text, const Tick& tick, CsvColumns columns);
// Reads one row (without its line end). Nothing, or a message without a place; `tick` is then
// incomplete. Numbers as std::from_chars takes them, in every locale, and finite. Values without a
// column are zero.
[[nodiscard]] std::optional<std::string> parse_csv_row(std::string_view line, CsvColumns columns,
                                                       Tick& tick);

// Appends the row as a line with one JSON object: the names and numbers of the CSV, then `lost`.
// Precondition: is_finite(tick).
void append_json_object(std::string& text, const Tick& tick, CsvColumns columns,
                        std::uint64_t lost);

}  // namespace hapticwall::file
