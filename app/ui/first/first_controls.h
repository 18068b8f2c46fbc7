// The head of the first window and its row of algorithms.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// Title, subject and buttons. Without room the subject goes first.
void draw_first_head(const PanelContext& context);

// The algorithms of the session; only their numbers where the names do not fit.
void draw_first_chips(const PanelContext& context);

}  // namespace hapticwall::ui
