// The picture of the wall with its labels; the pointer leads the hand and turns the picture.
#pragma once

#include "app/ui/ui_state.h"
#include "app/ui/wall_renderer.h"

namespace hapticwall::ui {

// Fills the current child window. A drag with the left button leads the hand, with the right one
// turns the picture, with the middle one moves it; the wheel zooms; a double click of the right or
// middle button shows the scene as at first.
void draw_wall_view(const PanelContext& context, WallRenderer& renderer);

// How draw_wall_view() shows a scene at first in a picture of this size.
[[nodiscard]] WallCamera wall_view_camera(const Scene& scene, ImVec2 size);

}  // namespace hapticwall::ui
