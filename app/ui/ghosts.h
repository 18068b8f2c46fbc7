// The other slot's newest contact, drawn over the present one.
#pragma once

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// Once a frame, before the plots: gives them the ghost, or takes it away. What it is made of is
// made anew only where another contact has begun, or another slot is the other one.
void show_ghost(const PanelContext& context);

}  // namespace hapticwall::ui
