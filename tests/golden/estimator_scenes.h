// Loops of a handle in a wall under an estimator of velocity, by formulas of their own.
#pragma once

#include <cmath>
#include <string>

#include "core/scene_keys.h"

namespace hapticwall::testing {

struct EstimatorChoice {
  std::string name;
  std::string key;
  double value = 0.0;
};

inline const EstimatorChoice kDifference{"backward-difference", "", 0.0};

inline Scene scene_of(const EstimatorChoice& estimator, double mass_kg, double wall_damping,
                      int delay_ticks = 0) {
  Scene scene;
  scene.sampling.rate_hz = 1000.0;
  scene.x().device.mass_kg = mass_kg;
  scene.x().device.damping_n_s_per_m = 1.0;
  if (delay_ticks > 0) scene.x().device.delay_ticks = delay_ticks;
  scene.x().walls = {{0.05, 1000.0, wall_damping}};
  scene.estimator.index = find_estimator(estimator.name).value();
  if (!estimator.key.empty())
    find_scene_number(scene, "estimator." + estimator.key).value().set(scene, estimator.value);
  return scene;
}

// A mass with a damper under a force that is held for a tick, in closed form.
template <typename Real>
void move_handle(Real& x, Real& v, double mass_kg, Real force_n) {
  const Real t = Real(1) / 1000;
  const Real left = std::exp(-t / Real(mass_kg));
  const Real way_s = Real(mass_kg) * (1 - left);
  x += v * way_s - force_n * (t - way_s);
  v = v * left - force_n * (1 - left);
}

}  // namespace hapticwall::testing
