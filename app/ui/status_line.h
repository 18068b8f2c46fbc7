// The two rows at the bottom: what there is to say, and how the loop is doing.
#pragma once

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_message_row(const PanelContext& context);
void draw_status_row(const PanelContext& context);

}  // namespace hapticwall::ui
