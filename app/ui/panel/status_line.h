// The two rows at the bottom: the most-used keys, and the state of the loop.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_hint_row(const PanelContext& context);
void draw_status_row(const PanelContext& context);

}  // namespace hapticwall::ui
