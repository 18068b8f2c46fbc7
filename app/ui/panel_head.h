// The head of the panel on the left: the program's name, undo and redo, settings, help.
#pragma once

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_panel_head(const PanelContext& context);

}  // namespace hapticwall::ui
