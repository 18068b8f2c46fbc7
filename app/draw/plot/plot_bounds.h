// Theoretical bounds of the wall's stiffness, as lines across the stiffness plot.
#pragma once

#include <string>
#include <vector>

#include "app/draw/plot/theme.h"
#include "core/study/stability_bounds.h"

namespace hapticwall::draw {

struct BoundLine {
  std::string label;
  double stiffness_n_per_m = 0.0;
};

// The bounds of the scene without the rule of thumb, the softest first; equal ones share a line.
[[nodiscard]] std::vector<BoundLine> bound_lines(const StabilityBounds& bounds);

// Draws those within the value axis of the current plot, whose unit is `scale` times SI: thin, with
// labels at the right edge.
void draw_bounds(const Theme& theme, const std::vector<BoundLine>& bounds, double scale);

}  // namespace hapticwall::draw
