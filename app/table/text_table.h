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

// The same of newtons per metre in kN/m, with two decimals.
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

// Titles, units, and one line per row.
template <typename Row>
[[nodiscard]] std::string table_of(std::type_identity_t<std::span<const Column<Row>>> columns,
                                   const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> cells(2 + rows.size());
  std::vector<Align> aligns;
  for (const Column<Row>& column : columns) {
    aligns.push_back(column.align);
    cells[0].emplace_back(column.title);
    cells[1].emplace_back(column.unit);
    for (std::size_t i = 0; i < rows.size(); ++i) cells[2 + i].push_back(column.text(rows[i]));
  }
  return aligned(cells, aligns);
}

// A study for people: heading, rows, and the meaning of their marks, if any.
template <typename Row>
[[nodiscard]] std::string study_text(const std::string& heading,
                                     std::type_identity_t<std::span<const Column<Row>>> columns,
                                     const std::vector<Row>& rows, const std::string& marks) {
  return heading + "\n" + table_of(columns, rows) + (marks.empty() ? "" : "\n" + marks);
}

}  // namespace hapticwall::table
