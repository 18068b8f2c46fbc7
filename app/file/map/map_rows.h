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

// The start of the cell's line: "none,1000,0.5,".
[[nodiscard]] std::string map_row_beginning(const StabilityMap& map, std::size_t cell);
inline constexpr std::size_t kMapMetrics = 6;  // numbers after the verdict

// Appends one line. Numbers have the shortest form that reads back the same; a missing one is an
// empty field.
void append_map_row(std::string& text, const StabilityMap& map, std::size_t cell,
                    const MapMetrics& metrics);

// Reads the line of this cell, without its end; nullopt for any other line.
[[nodiscard]] std::optional<MapMetrics> parse_map_row(std::string_view line,
                                                      const StabilityMap& map, std::size_t cell);

}  // namespace hapticwall::file
