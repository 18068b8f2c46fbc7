// Colours and scale. A choice takes effect at the next frame.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// Scale of everything, relative to the designed size.
[[nodiscard]] float scale_in_force(const UiState& state);
// The chosen one, %, without what the layout 'lecture' adds.
[[nodiscard]] int scale_percent_in_force(const UiState& state);

// 0 follows the screen; any other value is clamped to the allowed range.
void set_scale(UiState& state, int percent);
// One step larger (1) or smaller (-1).
void step_scale(UiState& state, int steps);

void toggle_look(const PanelContext& context);

}  // namespace hapticwall::ui
