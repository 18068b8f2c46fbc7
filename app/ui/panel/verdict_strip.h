// The verdict of the last second as a line of text.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

// Of the shown axis. Neutral during a blind test.
void draw_verdict_strip(const PanelContext& context);

}  // namespace hapticwall::ui
