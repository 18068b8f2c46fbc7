// The picture of the wall with its labels. The pointer leads the hand and moves the camera.
#pragma once

#include "app/ui/state/ui_state.h"
#include "app/ui/wall/wall_renderer.h"

namespace hapticwall::ui {

// Fills the current child window. Left drag leads the hand, right drag turns, middle drag moves,
// the wheel zooms. A double click (right or middle) restores the initial view.
void draw_wall_view(const PanelContext& context, WallRenderer& renderer);

// The initial view of draw_wall_view() in a picture of this size.
[[nodiscard]] WallCamera wall_view_camera(const Scene& scene, ImVec2 size);

}  // namespace hapticwall::ui
