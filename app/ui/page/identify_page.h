// The page "Identify": mass, damping, friction and delay of the session's device.
#pragma once

#include "app/ui/panel/identify_state.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

void draw_identify_page(const PanelContext& context);

// A page that is not seen ends its experiment, with zero force at the next tick.
void leave_identify_page(IdentifyState& identify);

}  // namespace hapticwall::ui
