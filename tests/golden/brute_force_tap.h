// The paper's device before its wall: its plant and its controller, for programs by brute force.
#pragma once

#include <cmath>

#include "tests/brute_force_plant.h"
#include "tests/reference_algorithms.h"

namespace hapticwall::testing {

inline constexpr double kPaperPeriodS = 1e-3;
inline constexpr double kPaperCountM = 0.254e-3;
inline constexpr int kPaperTicks = 6000;
inline constexpr int kPaperTail = 1000;
inline constexpr int kPaperSubsteps = 100;

// A hand without mass and grip goes from 30 mm to `end` at `rate`.
inline BruteForcePlant paper_plant(Real rate, Real end) {
  BruteForcePlant plant;
  plant.mass = 0.05L;
  plant.damping = 1.0L;
  plant.friction = 0.14L;
  plant.x = plant.y = 0.03L;
  const Real arrival = (end - 0.03L) / rate;
  plant.path = [=](Real t, Real inside) { return inside < arrival ? 0.03L + rate * t : end; };
  plant.path_velocity = [=](Real inside) { return inside < arrival ? rate : 0.0L; };
  return plant;
}

// The hand of the scenes tap and tap-slow.
inline BruteForcePlant tap_plant(Real rate, Real hand_damping = 5.0L) {
  BruteForcePlant plant = paper_plant(rate, 0.0653L);
  plant.hand_mass = 0.2L;
  plant.hand_stiffness = 300.0L;
  plant.hand_damping = hand_damping;
  plant.grip_stiffness = 2000.0L;
  plant.grip_damping = 2.0L;
  return plant;
}

inline ReferenceScene paper_controller() {
  ReferenceScene scene;
  scene.rate = 1.0 / kPaperPeriodS;
  scene.b = 1.0;
  scene.limit = 8.9;
  scene.walls = {{0.05, 35e3, 0.0}};
  scene.alpha_rest = 0.01;
  scene.c2 = scene.b * scene.rate;
  scene.coupling = 2.0 * scene.b * scene.rate;
  scene.alpha_most = scene.b;
  return scene;
}

// Position as the encoder measures it.
inline double measured_m(const BruteForcePlant& plant) {
  return kPaperCountM * std::rint(static_cast<double>(plant.x) / kPaperCountM);
}

}  // namespace hapticwall::testing
