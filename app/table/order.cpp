#include "app/table/order.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>

#include "app/file/text/text.h"
#include "core/summary.h"

namespace hapticwall::table {

bool before(const Place& a, const Place& b, bool descending) {
  if (a.missing != b.missing) return b.missing;
  return descending ? std::tie(b.number, b.word) < std::tie(a.number, a.word)
                    : std::tie(a.number, a.word) < std::tie(b.number, b.word);
}

Place place_of_cell(std::string_view cell) {
  cell = file::trimmed(cell);
  const std::string_view first = cell.substr(0, cell.find(' '));  // without a mark
  if (first == "-") return {};
  if (const auto number = file::parsed<double>(first)) return {false, *number, ""};
  if (const auto verdict = find_verdict(first)) return {false, static_cast<double>(*verdict), ""};
  return {false, 0.0, std::string(cell)};
}

std::vector<std::size_t> ordered(const Sheet& sheet, std::size_t column, bool descending) {
  std::vector<Place> places;
  for (const auto& row : sheet.rows) places.push_back(place_of_cell(row.at(column)));
  std::vector<std::size_t> indices(places.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  std::ranges::stable_sort(indices, [&](std::size_t a, std::size_t b) {
    return before(places[a], places[b], descending);
  });
  return indices;
}

}  // namespace hapticwall::table
