// Random scenes that a laboratory could have, for property tests.
#pragma once

#include <rapidcheck.h>

#include <cmath>

#include "core/algorithm/algorithm.h"
#include "core/scene.h"

namespace hapticwall::testing {

// Logarithmically uniform in [low, high].
inline double log_uniform(double low, double high) {
  constexpr int kSteps = 1000000;
  const double fraction = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, kSteps + 1)) /
                          static_cast<double>(kSteps);
  return low * std::pow(high / low, fraction);
}

inline double uniform(double low, double high) {
  constexpr int kSteps = 1000000;
  return low + (high - low) * (*rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, kSteps + 1)) /
                               static_cast<double>(kSteps));
}

inline bool flip() { return *rc::gen::arbitrary<bool>(); }

inline HandSettings random_hand() {
  HandSettings hand;
  hand.stiffness_n_per_m = log_uniform(10.0, 3000.0);
  hand.damping_n_s_per_m = flip() ? 0.0 : log_uniform(0.1, 100.0);
  if (flip()) {
    hand.mass_kg = log_uniform(0.05, 2.0);
    if (flip()) {
      hand.grip_stiffness_n_per_m = log_uniform(100.0, 1e4);
      if (flip()) hand.grip_damping_n_s_per_m = log_uniform(0.1, 20.0);
    }
  }
  hand.path = {{0.0, 0.03}, {log_uniform(0.05, 1.0), uniform(0.045, 0.08)}};
  if (flip()) hand.path.edit().push_back({hand.path.back().time_s + 0.123, 0.04});
  return hand;
}

// The name of one of all algorithms.
inline std::string_view any_algorithm() {
  return algorithms()[*rc::gen::inRange<std::size_t>(0, algorithms().size())].name;
}

// One second of contact with a wall at 0.05 m, under the algorithm that is named.
inline Scene random_scene(std::string_view algorithm) {
  Scene scene;
  scene.name = "random";
  scene.duration_s = 1.0;
  scene.sampling.rate_hz = flip() ? 1000.0 : std::round(log_uniform(200.0, 5000.0));
  scene.x().device.mass_kg = log_uniform(0.01, 1.0);
  scene.x().device.damping_n_s_per_m = flip() ? 1.0 : log_uniform(0.01, 20.0);
  if (flip()) scene.x().device.friction_n = log_uniform(0.01, 1.0);
  if (flip()) scene.x().device.encoder_m = log_uniform(1e-6, 1e-3);
  scene.x().device.force_limit_n = log_uniform(1.0, 100.0);
  scene.x().hand = random_hand();
  scene.x().walls = {{0.05, log_uniform(100.0, 1e5), 0.0}};
  scene.algorithm.index = find_algorithm(algorithm).value();
  if (flip()) {
    scene.algorithm.values.at(*find_algorithm_parameter("rest_force_step_n")) =
        log_uniform(1e-3, 1.0);
  }
  return scene;
}

}  // namespace hapticwall::testing
