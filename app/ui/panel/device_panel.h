// The device: its parameters where it is simulated, else the state of its link.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_device_section(const PanelContext& context);

}  // namespace hapticwall::ui
