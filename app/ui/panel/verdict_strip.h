// The verdict of the last second as a line of text.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// Draws the verdict of the shown axis. Neutral during a blind test.
void draw_verdict_strip(const PanelContext& context);

}  // namespace hapticwall::ui
