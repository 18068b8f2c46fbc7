#include "app/table/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace hapticwall::table {
namespace {

constexpr const char* kGap = "  ";

// The width on a terminal: continuation bytes of UTF-8 take no place.
std::size_t width_of(const std::string& text) {
  constexpr unsigned kContinuationMask = 0xC0U;
  constexpr unsigned kContinuation = 0x80U;
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) {
    return (static_cast<unsigned char>(c) & kContinuationMask) != kContinuation;
  }));
}

}  // namespace

std::string kilonewtons_per_metre(std::optional<double> value_n_per_m) {
  return fixed(value_n_per_m, 1.0 / kNewtonsPerKilonewton, 2);
}

std::string changes_text(std::size_t changes) {
  return fmt::format("{} {}", changes, changes > 1 ? '!' : ' ');
}

std::string aligned(const std::vector<std::vector<std::string>>& rows,
                    std::span<const Align> columns) {
  std::vector<std::size_t> widths(columns.size());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      widths[i] = std::max(widths[i], width_of(row.at(i)));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string space(widths[i] - width_of(row[i]), ' ');
      if (i > 0) line += kGap;
      line += columns[i] == Align::kLeft ? row[i] + space : space + row[i];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string sheet_text(const Sheet& sheet) {
  std::vector<std::vector<std::string>> lines(2);
  std::vector<Align> aligns;
  for (const Sheet::Head& column : sheet.columns) {
    lines[0].push_back(column.title);
    lines[1].push_back(column.unit);
    aligns.push_back(column.align);
  }
  lines.insert(lines.end(), sheet.rows.begin(), sheet.rows.end());
  return (sheet.heading.empty() ? "" : sheet.heading + "\n") + aligned(lines, aligns) +
         (sheet.marks.empty() ? "" : "\n" + sheet.marks);
}

}  // namespace hapticwall::table
