// The brute-force plant and output of a scene: its numbers, copied. Tests only.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/scene.h"
#include "tests/brute_force_plant.h"

namespace hapticwall::testing {

// The straight pieces of a path, each as a line of its own.
class BruteForcePath {
 public:
  explicit BruteForcePath(std::vector<PathPoint> points) : points_(std::move(points)) {}

  // Position at `time`, on the line of the piece that contains `inside`.
  [[nodiscard]] Real position(Real time, Real inside) const {
    const std::size_t i = piece(inside);
    return points_[i].position_m + speed_of(i) * (time - points_[i].time_s);
  }
  [[nodiscard]] Real speed(Real inside) const { return speed_of(piece(inside)); }

 private:
  [[nodiscard]] std::size_t piece(Real inside) const {
    std::size_t i = 0;
    while (i + 1 < points_.size() && inside >= static_cast<Real>(points_[i + 1].time_s)) ++i;
    return i;
  }
  [[nodiscard]] Real speed_of(std::size_t i) const {
    if (i + 1 >= points_.size()) return 0;
    return (static_cast<Real>(points_[i + 1].position_m) - points_[i].position_m) /
           (static_cast<Real>(points_[i + 1].time_s) - points_[i].time_s);
  }

  std::vector<PathPoint> points_;
};

inline BruteForcePlant brute_force_plant(const Scene& scene) {
  BruteForcePlant plant;
  const DeviceSettings& device = scene.x().device;
  plant.mass = device.mass_kg;
  plant.damping = device.damping_n_s_per_m;
  plant.friction = device.friction_n.value_or(0.0);
  plant.time_constant = device.amplifier_time_constant_s.value_or(0.0);
  plant.x = plant.y = device.start_m;
  if (!scene.x().hand) return plant;
  const HandSettings& hand = *scene.x().hand;
  plant.hand_stiffness = hand.stiffness_n_per_m;
  plant.hand_damping = hand.damping_n_s_per_m;
  if (hand.grip_stiffness_n_per_m) {
    plant.hand_mass = *hand.mass_kg;
    plant.grip_stiffness = *hand.grip_stiffness_n_per_m;
    plant.grip_damping = hand.grip_damping_n_s_per_m.value_or(0.0);
  } else {
    plant.mass += hand.mass_kg.value_or(0.0);
  }
  const BruteForcePath path(hand.path.points());
  plant.path = [path](Real time, Real inside) { return path.position(time, inside); };
  plant.path_velocity = [path](Real inside) { return path.speed(inside); };
  return plant;
}

inline BruteForceOutput brute_force_output(const Scene& scene) {
  BruteForceOutput output;
  output.resolution = scene.x().device.force_resolution_n.value_or(0.0);
  output.limit = scene.x().device.force_limit_n.value_or(0.0);
  output.delay = static_cast<std::size_t>(scene.x().device.delay_ticks.value_or(0));
  return output;
}

}  // namespace hapticwall::testing
