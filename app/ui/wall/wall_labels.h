// Labels over the picture of the wall.
#pragma once

#include <imgui.h>

#include <span>
#include <string>

#include "app/draw/plot/theme.h"
#include "app/ui/wall/label_pen.h"
#include "app/ui/wall/wall_camera.h"
#include "app/ui/wall/wall_measures.h"

namespace hapticwall::ui {

// Draws force, names and values beside walls, handle, its true place and hand, rulers along the
// axes, and the colour bar of stiffness, the most important first: a label that would meet an
// earlier one or an area that is taken is left out. `rhythm`: beside the handle, empty while it is
// quiet.
void draw_wall_labels(const draw::Theme& theme, const WallPicture& picture,
                      const WallCamera& camera, const ViewArea& area,
                      std::span<const draw::PixelBox> taken, const std::string& rhythm);
// The labels of a small picture: the wall, the hand, and F_max at its mark.
void draw_few_wall_labels(const draw::Theme& theme, const WallPicture& picture,
                          const WallCamera& camera, const ViewArea& area);

}  // namespace hapticwall::ui
