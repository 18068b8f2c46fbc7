// The cells of a stability map as lines of CSV.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/study/stability_map.h"

namespace hapticwall::file {

// "algorithm,KEY of x,KEY of y,verdict,tail_peak_to_peak_m,...", with a line end.
[[nodiscard]] std::string map_header(const StabilityMap& map);

// Where the cell stands, as its line begins: "none,1000,0.5,".
[[nodiscard]] std::string map_row_beginning(const StabilityMap& map, std::size_t cell);
inline constexpr std::size_t kMapFigures = 6;  // numbers behind the verdict

// One line with its end. Numbers are in the shortest form that reads back the same; what does not
// apply is an empty field.
void append_map_row(std::string& text, const StabilityMap& map, std::size_t cell,
                    const MapFigures& figures);

// The line (without its end) where it is that of the cell, else nothing.
[[nodiscard]] std::optional<MapFigures> parse_map_row(std::string_view line,
                                                      const StabilityMap& map, std::size_t cell);

}  // namespace hapticwall::file
