// The order of the rows of a table.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/table/text_table.h"

namespace hapticwall::table {

// A value to sort by: by number, then by word.
struct Place {
  bool missing = true;
  double number = 0.0;
  std::string word;
};

// Missing values come last in either direction.
[[nodiscard]] bool before(const Place& a, const Place& b, bool descending);

// Of a cell as it is printed: its number, or its words; a verdict ranks from good to bad. "-" is
// missing.
[[nodiscard]] Place place_of_cell(std::string_view cell);

// Indices of cells in their order; ties keep the order of the list.
[[nodiscard]] std::vector<std::size_t> ordered(const std::vector<std::string>& cells,
                                               bool descending);

// The cells of a column, one per row.
template <typename Row>
[[nodiscard]] std::vector<std::string> cells_of(const Column<Row>& column,
                                                const std::vector<Row>& rows) {
  std::vector<std::string> cells;
  for (const Row& row : rows) cells.push_back(column.text(row));
  return cells;
}

}  // namespace hapticwall::table
