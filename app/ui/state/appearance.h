// Dark or light, and how large everything is: chosen in the window, in force at the next frame.
#pragma once

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// How much larger than designed everything is drawn.
[[nodiscard]] float scale_in_force(const UiState& state);
[[nodiscard]] int scale_percent_in_force(const UiState& state);

// 0: as the screen says; else kept within the range that there is.
void set_scale(UiState& state, int percent);
// One step larger (1) or smaller (-1).
void step_scale(UiState& state, int steps);

void toggle_look(const PanelContext& context);

}  // namespace hapticwall::ui
