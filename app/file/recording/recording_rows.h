// The lines of a recording's CSV: its columns, its header and its rows, written and read back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::file {

// A column of an algorithm's signal.
struct SignalColumn {
  std::string name;       // without the axis prefix
  std::size_t place = 0;  // index in Sample::signals

  friend bool operator==(const SignalColumn&, const SignalColumn&) = default;
};

// The columns of a recording. Those of axis y follow those of axis x and have the prefix y_.
struct CsvColumns {
  ColumnGroup source = ColumnGroup::kTruth;  // kTruth or kDevice
  std::uint8_t axes = 1;
  bool applied = false;                 // has kApplied, which older recordings of devices lack
  std::vector<SignalColumn> signals{};  // the last columns of each axis

  [[nodiscard]] bool of_simulator() const { return source == ColumnGroup::kTruth; }
  friend bool operator==(const CsvColumns&, const CsvColumns&) = default;
};
[[nodiscard]] SignalNames signal_names(const CsvColumns& columns);

[[nodiscard]] inline CsvColumns csv_columns(bool simulated, std::size_t axes = 1) {
  return {simulated ? ColumnGroup::kTruth : ColumnGroup::kDevice, static_cast<std::uint8_t>(axes),
          !simulated};
}
// The signals of these algorithms, indices in algorithms(), each once.
[[nodiscard]] std::vector<SignalColumn> signal_columns(std::span<const std::size_t> indices);
// signal_columns() of every algorithm.
[[nodiscard]] std::vector<SignalColumn> all_signal_columns();
// signal_columns() of every algorithm that the settings name, with followers.
[[nodiscard]] std::vector<SignalColumn> signal_columns(const Scene& scene,
                                                       std::span<const ScheduledChange> changes);

// Upper limit of a line in bytes, without its line end.
inline constexpr std::size_t kMaxCsvLineBytes = 2048;

// The header line without its line end.
[[nodiscard]] std::string csv_header(const CsvColumns& columns);
// The columns that a header line (without its end) names. The error has no place yet: the caller
// puts "NAME.csv:1: " in front of it.
[[nodiscard]] Result<CsvColumns> parse_csv_header(std::string_view line);

// Appends one row with its line end. Numbers have the shortest form that reads back to the same
// double, in every locale. Precondition: the tick has as many axes as the columns.
void append_csv_row(std::string& text, const Tick& tick, const CsvColumns& columns);
// Reads one row (without its line end). Nothing, or a message without a place; `tick` is then
// incomplete. Numbers as std::from_chars takes them, in every locale, and finite; a signal may
// be empty. Values without a column are zero.
[[nodiscard]] std::optional<std::string> parse_csv_row(std::string_view line,
                                                       const CsvColumns& columns, Tick& tick);

// Appends the row as a line with one JSON object: the names and numbers of the CSV (a signal that
// has none: null), then `lost`.
// Precondition: is_finite(tick).
void append_json_object(std::string& text, const Tick& tick, const CsvColumns& columns,
                        std::uint64_t lost);

}  // namespace hapticwall::file
