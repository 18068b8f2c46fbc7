// A map or its boundaries as text: for people, and for programs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/study/boundary.h"
#include "core/study/stability_map.h"

namespace hapticwall::command {

// How many cells of each verdict, a line an algorithm. `figures`: of cells `begin` and following.
[[nodiscard]] std::string map_table(const StabilityMap& map, std::size_t begin,
                                    std::span<const MapFigures> figures);
[[nodiscard]] std::string map_json(const StabilityMap& map, std::size_t begin,
                                   std::span<const MapFigures> figures);

// A line a boundary, and what its marks mean.
[[nodiscard]] std::string boundary_table(const BoundaryPlan& plan,
                                         const std::vector<Boundary>& boundaries);
[[nodiscard]] std::string boundary_json(const BoundaryPlan& plan,
                                        const std::vector<Boundary>& boundaries);
[[nodiscard]] std::string boundary_csv(const BoundaryPlan& plan,
                                       const std::vector<Boundary>& boundaries);

}  // namespace hapticwall::command
