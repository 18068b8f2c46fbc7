// The ghost: the other slot's newest contact, drawn over the present one.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

// Call it once a frame, before the plots. Rebuilds the ghost only for a new contact or another
// slot.
void show_ghost(const PanelContext& context);

}  // namespace hapticwall::ui
