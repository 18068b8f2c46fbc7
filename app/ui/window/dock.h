// The dock area of the window and the pages in it.
#pragma once

#include "app/ui/page/pages.h"

namespace hapticwall::ui {

// Fills the current window to `size` and draws every page that is seen. Keeps what the user moves.
void draw_dock(const PageParts& parts, ImVec2 size);

}  // namespace hapticwall::ui
