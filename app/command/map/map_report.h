// A map or its boundaries as table, JSON and CSV.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/study/boundary.h"
#include "core/study/stability_map.h"

namespace hapticwall::command {

// Number of cells of each verdict, one line per algorithm. `metrics`: of the cells from `begin`.
[[nodiscard]] std::string map_table(const StabilityMap& map, std::size_t begin,
                                    std::span<const MapMetrics> metrics);
[[nodiscard]] std::string map_json(const StabilityMap& map, std::size_t begin,
                                   std::span<const MapMetrics> metrics);

// One line per boundary, and the meaning of the marks.
[[nodiscard]] std::string boundary_table(const BoundaryPlan& plan,
                                         const std::vector<Boundary>& boundaries);
[[nodiscard]] std::string boundary_json(const BoundaryPlan& plan,
                                        const std::vector<Boundary>& boundaries);
[[nodiscard]] std::string boundary_csv(const BoundaryPlan& plan,
                                       const std::vector<Boundary>& boundaries);

// One line per simulated point.

}  // namespace hapticwall::command
