// The help: every key and every gesture of the pointer.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

void draw_help(const PanelContext& context);

// Closes an open list, the help, or the newest message.
void put_away(const PanelContext& context);

}  // namespace hapticwall::ui
