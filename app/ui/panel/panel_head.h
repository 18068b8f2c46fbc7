// Head of the control panel: program name, undo and redo, settings, help.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_panel_head(const PanelContext& context);

// Opens or closes the help: the button "?" and the key F1.
void toggle_help(const PanelContext& context);

}  // namespace hapticwall::ui
