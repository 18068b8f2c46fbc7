// What theory says of the stiffest wall, as lines across the stiffness plot.
#pragma once

#include <string>
#include <vector>

#include "app/ui/theme.h"
#include "core/scene.h"
#include "core/stability_bounds.h"

namespace hapticwall::ui {

struct BoundLine {
  std::string label;
  double stiffness_n_per_m = 0.0;
};

// Those that the scene has, the softest first; equal ones are one line.
[[nodiscard]] std::vector<BoundLine> bound_lines(const StabilityBounds& bounds);

// Those within the value axis of the current plot, whose unit is `scale` times SI: thin, with their
// labels at the right edge.
void draw_bounds(const Theme& theme, const std::vector<BoundLine>& bounds, double scale);

}  // namespace hapticwall::ui
