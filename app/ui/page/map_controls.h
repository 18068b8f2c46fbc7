// The choices of the map page: two numbers, their ranges, the algorithms.
#pragma once

#include "app/ui/computed/map_choice.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// `map`: of this frame.
void draw_map_controls(const PanelContext& context, MapChoice& choice, const StabilityMap& map);

}  // namespace hapticwall::ui
