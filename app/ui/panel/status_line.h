// The two rows at the bottom: the keys that one wants most, and how the loop is doing.
#pragma once

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_hint_row(const PanelContext& context);
void draw_status_row(const PanelContext& context);

}  // namespace hapticwall::ui
