// The switch and the volume of the live sound.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

// In the row of the last item where it fits.
void draw_sound_switch(const PanelContext& context);

}  // namespace hapticwall::ui
