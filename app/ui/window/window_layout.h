// Layout of the window: session and verdict above, the dock area, status below, messages and help
// on top.
#pragma once

#include "app/draw/plot/sample_history.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/wall/wall_renderer.h"

namespace hapticwall::ui {

// Draws a whole frame.
void draw_window(const PanelContext& context, const draw::SampleHistory& history,
                 WallRenderer& renderer);

}  // namespace hapticwall::ui
