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

// Place of a cell as it is printed: its number, or its words; a verdict ranks from good to bad. "-"
// is missing.
[[nodiscard]] Place place_of_cell(std::string_view cell);

// Indices of the rows in the order of this column; ties keep the order of the sheet.
[[nodiscard]] std::vector<std::size_t> ordered(const Sheet& sheet, std::size_t column,
                                               bool descending);

}  // namespace hapticwall::table
