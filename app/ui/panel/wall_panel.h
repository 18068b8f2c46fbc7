// The walls of the shown axis, and their stability bounds.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_wall_section(const PanelContext& context);

}  // namespace hapticwall::ui
