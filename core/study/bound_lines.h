// Lines on a map where the stiffness of the first wall equals a bound of stability_bounds().
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/study/stability_bounds.h"
#include "core/study/stability_map.h"

namespace hapticwall {

// In steps of the axes: (0, 0) is the first value of both axes, count - 1 the last.
struct MapPoint {
  double x = 0.0;
  double y = 0.0;

  friend bool operator==(const MapPoint&, const MapPoint&) = default;
};

struct BoundSegment {
  MapPoint from;
  MapPoint to;

  friend bool operator==(const BoundSegment&, const BoundSegment&) = default;
};

using BoundMember = std::optional<double> StabilityBounds::*;

struct CellBounds {
  double wall_n_per_m = 0.0;  // stiffness of the first wall
  StabilityBounds bounds;
};

// Of the grid's points, which are the same under every algorithm; x varies fastest. Empty if the
// scene has no wall. Realtime-safe: no.
[[nodiscard]] std::vector<CellBounds> cell_bounds(const StabilityMap& map);

// `cells`: of the map. Interpolates linearly between the values of the axes: exact for a power of a
// key on logarithmic axes, and for a multiple on linear ones. Empty if no cell has the bound, or no
// two neighbours lie on different sides of it. Realtime-safe: no.
[[nodiscard]] std::vector<BoundSegment> bound_lines(const StabilityMap& map,
                                                    std::span<const CellBounds> cells,
                                                    BoundMember bound);

}  // namespace hapticwall
