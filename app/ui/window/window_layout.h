// Layout of the window: session and verdict above, the dock area, status below, messages and help
// on top.
#pragma once

#include "app/ui/page/pages.h"

namespace hapticwall::ui {

// Draws a whole frame.
void draw_window(const PageParts& parts);

}  // namespace hapticwall::ui
