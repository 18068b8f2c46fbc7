// Where everything stands in the window: the panel on the left, views and plots on the right, the
// status below, messages and help over it all.
#pragma once

#include "app/ui/sample_history.h"
#include "app/ui/ui_state.h"
#include "app/ui/wall_renderer.h"

namespace hapticwall::ui {

// Draws all of a frame.
void draw_window(const PanelContext& context, const SampleHistory& history, WallRenderer& renderer);

}  // namespace hapticwall::ui
