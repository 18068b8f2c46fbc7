// The scene `tap` of assets/scenes, without a hand.
#pragma once

#include <string_view>

#include "core/algorithm/algorithm.h"
#include "core/scene.h"

namespace hapticwall::testing {

inline Scene tap_device(std::string_view algorithm, double duration_s) {
  Scene scene;
  scene.name = "tap";
  scene.duration_s = duration_s;
  DeviceSettings& device = scene.x().device;
  device.mass_kg = 0.05;
  device.damping_n_s_per_m = 1.0;
  device.friction_n = 0.14;
  device.encoder_m = 0.254e-3;
  device.force_limit_n = 8.9;
  scene.x().walls = {{0.05, 35000.0, 0.0}};
  scene.algorithm.index = find_algorithm(algorithm).value();
  return scene;
}

// The same without friction and encoder, which hide small faults of an algorithm.
inline Scene ideal_device(std::string_view algorithm, double duration_s) {
  Scene scene = tap_device(algorithm, duration_s);
  scene.x().device.friction_n.reset();
  scene.x().device.encoder_m.reset();
  return scene;
}

inline void set_parameter(Scene& scene, std::string_view key, double value) {
  scene.algorithm.values.at(find_algorithm_parameter(key).value()) = value;
}

}  // namespace hapticwall::testing
