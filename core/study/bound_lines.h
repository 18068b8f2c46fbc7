// Lines on a map where the stiffness of the first wall equals a bound of stability_bounds().
#pragma once

#include <optional>
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

// Interpolates linearly between the values of the axes: exact for a power of a key on logarithmic
// axes, and for a multiple on linear ones. Empty if no cell has the bound, no two neighbours lie on
// different sides of it, or the scene has no wall. Realtime-safe: no.
[[nodiscard]] std::vector<BoundSegment> bound_lines(const StabilityMap& map, BoundMember bound);

}  // namespace hapticwall
