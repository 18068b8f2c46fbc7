// The picture of the wall, with its labels, and the pointer as the hand.
#pragma once

#include "app/ui/ui_state.h"
#include "app/ui/wall_renderer.h"

namespace hapticwall::ui {

// Fills the current child window. Dragging in it leads the hand.
void draw_wall_view(const PanelContext& context, WallRenderer& renderer);

// The camera that draw_wall_view() uses for a picture of this size.
[[nodiscard]] WallCamera wall_view_camera(const Scene& scene, ImVec2 size);

}  // namespace hapticwall::ui
