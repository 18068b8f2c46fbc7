// What is written over the picture of the wall.
#pragma once

#include <imgui.h>

#include <string>

#include "app/ui/ui_state.h"
#include "app/ui/wall_camera.h"
#include "app/ui/wall_picture.h"

namespace hapticwall::ui {

// The part of the window that the picture fills.
struct ViewArea {
  ImVec2 corner;
  ImVec2 size;
};

// How much of the panel's colour is behind a text, so that it is read over anything.
inline constexpr float kBehindText = 0.72F;

// Names and figures beside walls, handle, proxy, hand and force, rulers along the axes, and the
// scale of the stiffness colours.
void draw_wall_labels(const Theme& theme, const WallPicture& picture, const WallCamera& camera,
                      const ViewArea& area);

// "35 kN/m", "350 N/m".
[[nodiscard]] std::string stiffness_text(double n_per_m);

}  // namespace hapticwall::ui
