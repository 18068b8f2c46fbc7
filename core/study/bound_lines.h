// Lines on a map where the first wall equals a bound of stability_bounds(), or what CHAI3D allows.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/study/stability_bounds.h"
#include "core/study/stability_map.h"

namespace hapticwall {

// Point in steps of the axes: (0, 0) is the first value of both axes, count - 1 the last.
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
  WallSettings wall;  // the first one
  StabilityBounds bounds;
};

// Bounds of the grid's points, which are the same under every algorithm; x varies fastest. Empty if
// the scene has no wall. Realtime-safe: no.
[[nodiscard]] std::vector<CellBounds> cell_bounds(const StabilityMap& map);

// `cells`: of the map. Interpolates linearly between the values of the axes: exact for a power of a
// key on logarithmic axes, and for a multiple on linear ones. Empty if no cell has the bound, or no
// two neighbours lie on different sides of it. Realtime-safe: no.
[[nodiscard]] std::vector<BoundSegment> bound_lines(const StabilityMap& map,
                                                    std::span<const CellBounds> cells,
                                                    BoundMember bound);

// bound_lines() for the limits that CHAI3D sets for the device: its stiffness where the damping is
// allowed, and its damping where the stiffness is. Empty unless the scene has both numbers.
// Realtime-safe: no.
[[nodiscard]] std::vector<BoundSegment> chai3d_lines(const StabilityMap& map,
                                                     std::span<const CellBounds> cells);

}  // namespace hapticwall
