// Scenes whose stability theory knows: a handle that a soft spring presses into a wall.
#pragma once

#include "core/scene.h"

namespace hapticwall::testing {

inline constexpr double kWallAtM = 0.05;
inline constexpr double kPressN = 4.75;

// 0.05 kg, 1 N·s/m, 1 kHz; about 4.75 N of a hand of 5 N/m. It starts 0.2 mm out of its rest in the
// wall, so that a loop that is stable never leaves it.
inline Scene pressed_wall(double stiffness_n_per_m) {
  Scene scene;
  scene.name = "pressed";
  scene.duration_s = 100.0;
  scene.x().device.mass_kg = 0.05;
  scene.x().device.damping_n_s_per_m = 1.0;
  scene.x().hand = HandSettings{};
  scene.x().hand->stiffness_n_per_m = 5.0;
  scene.x().hand->path = {{0.0, 1.0}};
  scene.x().walls = {{kWallAtM, stiffness_n_per_m, 0.0}};
  scene.x().device.start_m = kWallAtM + kPressN / stiffness_n_per_m + 0.2e-3;
  return scene;
}

}  // namespace hapticwall::testing
