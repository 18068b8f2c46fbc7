// What the wall view and the magnifier remember from frame to frame.
#pragma once

#include <array>
#include <cstdint>

#include "app/ui/sample_history.h"
#include "app/ui/wall_camera.h"
#include "app/ui/wall_picture.h"

namespace hapticwall::ui {

// What a button that is held down over the wall view does.
enum class ViewDrag : std::uint8_t { kNone, kLeadHand, kTurn, kShift };

// Where the magnifier looks, metres.
struct Magnified {
  double face_m = 0.0;    // of the wall that it is about
  double middle_m = 0.0;  // of what it shows
};

struct WallState {
  // Worth keeping from one start of the program to the next.
  struct Persisted {
    WallOrbit orbit;
    int magnification = 0;  // 10 to 1000; 0: as suits the contact
  };
  struct Transient {
    ViewDrag drag = ViewDrag::kNone;
    std::array<ShownStiffness, kAxisCount> shown{};  // the tint, as it fades
    bool view_refined = true;  // false: the picture of the wall gets better in the next frames
    int magnification = 0;     // in force; 0: none yet
    Magnified magnified;
    Trace trail;  // of the handle's last moments, as it was drawn last
  };

  Persisted persisted;
  Transient transient;
};

}  // namespace hapticwall::ui
