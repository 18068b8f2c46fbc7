// Layout of the window: session and verdict above, the dock area, status below, messages and help
// on top.
#pragma once

#include "app/ui/first/first_window.h"
#include "app/ui/page/pages.h"

namespace hapticwall::ui {

// Fills the current window to `size` with the dock area and draws every page in it that is seen.
// Keeps what the user moves.
void draw_dock(const PageParts& parts, ImVec2 size);

// Draws a whole frame.
void draw_window(const FirstParts& parts);

}  // namespace hapticwall::ui
