// Where on a map theory draws its lines: the places at which the stiffness of the scene's first
// wall is just a bound of stability_bounds().
#pragma once

#include <optional>
#include <vector>

#include "core/stability_bounds.h"
#include "core/study/stability_map.h"

namespace hapticwall {

// In steps of the axes: (0, 0) is the first value of both, (count - 1) the last.
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

// Between the values of the axes straight lines stand for the bound, straight on the axes as they
// are: a power of a key is exact where both axes are logarithmic, a multiple where they are not.
// Empty where no cell has the bound, or no two neighbours lie on different sides of it, or the
// scene has no wall. Realtime-safe: no.
[[nodiscard]] std::vector<BoundSegment> bound_lines(const StabilityMap& map, BoundMember bound);

}  // namespace hapticwall
