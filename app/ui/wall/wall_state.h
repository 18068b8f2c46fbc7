// State of the wall view and of the magnifier.
#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>

#include "app/draw/plot/sample_history.h"
#include "app/ui/wall/wall_camera.h"
#include "app/ui/wall/wall_measures.h"
#include "app/ui/wall/wall_resolution.h"
#include "core/scene.h"

namespace hapticwall::ui {

// Action of the mouse button that is held in the wall view.
enum class ViewDrag : std::uint8_t { kNone, kLeadHand, kTurn, kShift };

// Magnifications of the contact, relative to the wall view as it first shows a scene.
inline constexpr std::array kMagnifications{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};

// View of the magnifier, m.
struct Magnified {
  double face_m = 0.0;    // face of the magnified wall
  double middle_m = 0.0;  // centre of the view
};

struct WallState {
  // Stored in the settings file.
  struct Persisted {
    WallOrbit orbit;
    int magnification = 0;  // 1 to 1000; 0: automatic
  };
  struct Transient {
    ViewDrag drag = ViewDrag::kNone;
    std::array<ShownStiffness, kAxisCount> shown{};  // the fading tint of the walls
    std::array<Swept, kAxisCount> swept{};
    WallResolution resolution;
    bool view_refined = true;  // false: the picture still improves in the next frames
    int magnification = 0;     // in force; 0: none yet
    ImVec2 view_size;          // of the newest view, px
    Magnified magnified;
    draw::Trace trail;  // recent motion of the handle
  };

  Persisted persisted;
  Transient transient;
};

}  // namespace hapticwall::ui
