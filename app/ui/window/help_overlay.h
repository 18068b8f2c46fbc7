// The help over the window: what every key and every gesture of the pointer does.
#pragma once

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_help(const PanelContext& context);

void toggle_help(const PanelContext& context);

// Closes an open list or the help, else puts the newest message away.
void put_away(const PanelContext& context);

}  // namespace hapticwall::ui
