// The simulated hand: its script, or the pointer.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_hand_section(const PanelContext& context);

}  // namespace hapticwall::ui
