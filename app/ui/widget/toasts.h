// The messages, drawn over the window.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// Stacks the messages over everything else, the newest at the bottom. (right, bottom) is their
// lower right corner.
void draw_toasts(const PanelContext& context, float right, float bottom);

}  // namespace hapticwall::ui
