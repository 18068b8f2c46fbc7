// The picture of the wall with its labels. The pointer leads the hand and moves the camera.
#pragma once

#include "app/ui/state/panel_context.h"
#include "app/ui/wall/label_pen.h"
#include "app/ui/wall/wall_renderer.h"

namespace hapticwall::ui {

// Fills the current child window. Left drag leads the hand, right drag turns, middle drag moves,
// the wheel zooms. A double click (right or middle) restores the initial view.
void draw_wall_view(const PanelContext& context, WallRenderer& renderer);

// Picture that draw_wall_view() draws: the interval since the last frame, with the fading tint. In
// a blind test the same for every wall. Call it once a frame.
[[nodiscard]] WallPicture shown_picture(const PanelContext& context);

// A picture of the first window: with few labels and without a readout. Returns its camera.
[[nodiscard]] WallCamera draw_wall_pane(const PanelContext& context, WallRenderer& renderer,
                                        const Scene& scene, const WallPicture& picture,
                                        const ViewArea& area);
// The invisible item over the picture, by which the pointer leads the hand and moves the camera.
void take_wall_pointer(const PanelContext& context, const WallCamera& camera, const ViewArea& area);

// The initial view of draw_wall_view() in a picture of this size.
[[nodiscard]] WallCamera wall_view_camera(const Scene& scene, ImVec2 size);

}  // namespace hapticwall::ui
