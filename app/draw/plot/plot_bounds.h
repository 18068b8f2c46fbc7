// Bounds as lines across a plot: of the wall's stiffness by theory, of the actuator's force.
#pragma once

#include <string>
#include <vector>

#include "app/draw/plot/plot_labels.h"
#include "app/draw/plot/theme.h"
#include "core/study/stability_bounds.h"

namespace hapticwall::draw {

struct BoundLine {
  std::string label;
  double value = 0.0;  // SI
};

// The bounds of the scene without the rule of thumb, the softest first; equal ones share a line.
[[nodiscard]] std::vector<BoundLine> bound_lines(const StabilityBounds& bounds);

// Draws the bounds within the value axis of the current plot, whose unit is `scale` times SI. Lines
// are thin; labels stand in a free place, as far to the right as possible.
void draw_bounds(const Theme& theme, const std::vector<BoundLine>& bounds, double scale,
                 PlotInk& ink);

}  // namespace hapticwall::draw
