// The legend of a stability map: colours in words, a colour bar of the amplitude, the bounds.
#pragma once

#include <span>

#include "app/draw/figure/map_bounds.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {

// In as many lines as they need. Only verdicts among `figures` have a key. `scale`: of the lines.
void draw_map_legend(const Theme& theme, std::span<const MapMetrics> figures,
                     std::span<const BoundLines> bounds, float scale);

}  // namespace hapticwall::draw
