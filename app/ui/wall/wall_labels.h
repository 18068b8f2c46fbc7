// Labels over the picture of the wall.
#pragma once

#include <imgui.h>

#include <string>

#include "app/draw/plot/theme.h"
#include "app/ui/wall/wall_camera.h"
#include "app/ui/wall/wall_picture.h"

namespace hapticwall::ui {

// Area of the picture in the window.
struct ViewArea {
  ImVec2 corner;
  ImVec2 size;
};

// Opacity of the background behind labels.
inline constexpr float kBehindText = 0.72F;

// Draws names and values beside walls, handle, its true place, hand and force, rulers along the
// axes, and the colour bar of stiffness. `rhythm`: beside the handle, empty while it is quiet.
void draw_wall_labels(const draw::Theme& theme, const WallPicture& picture,
                      const WallCamera& camera, const ViewArea& area, const std::string& rhythm);

// "35 kN/m", "350 N/m".
[[nodiscard]] std::string stiffness_text(double n_per_m);

}  // namespace hapticwall::ui
