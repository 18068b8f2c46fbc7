// Tables as text: a column states its title, its unit and how a row fills its cell.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "app/file/text/text.h"

namespace hapticwall::table {

using file::fixed;

// Newtons per metre as kN/m with two decimals; "-" without a value.
[[nodiscard]] std::string kilonewtons_per_metre(std::optional<double> value_n_per_m);

// "3 !" where the verdict changes more than once; kManyChangesNote explains the mark.
[[nodiscard]] std::string changes_text(std::size_t changes);
inline constexpr std::string_view kManyChangesNote =
    "! the verdict changes more than once; a finer scan may find more changes and an earlier "
    "failure\n";

enum class Align : bool { kRight, kLeft };

// The rows as aligned lines. Precondition: every row has as many cells as `columns`.
[[nodiscard]] std::string aligned(const std::vector<std::vector<std::string>>& rows,
                                  std::span<const Align> columns);

template <typename Row>
struct Column {
  std::string_view title;
  std::string_view unit;
  std::string (*text)(const Row&);
  Align align = Align::kRight;
};

// A filled table for people.
struct Sheet {
  struct Head {
    std::string title;
    std::string unit;
    Align align = Align::kRight;
  };
  std::string heading;  // lines, or ""
  std::vector<Head> columns;
  std::vector<std::vector<std::string>> rows;  // a cell for each column
  std::string marks;                           // the meaning of marks in cells: lines, or ""
};

// The sheet without heading and marks.
template <typename Row>
[[nodiscard]] Sheet sheet_of(std::type_identity_t<std::span<const Column<Row>>> columns,
                             const std::vector<Row>& rows) {
  Sheet sheet;
  sheet.rows.resize(rows.size());
  for (const Column<Row>& column : columns) {
    sheet.columns.push_back({std::string(column.title), std::string(column.unit), column.align});
    for (std::size_t i = 0; i < rows.size(); ++i) sheet.rows[i].push_back(column.text(rows[i]));
  }
  return sheet;
}

// Heading, titles, units, one line per row, marks.
[[nodiscard]] std::string sheet_text(const Sheet& sheet);

}  // namespace hapticwall::table
