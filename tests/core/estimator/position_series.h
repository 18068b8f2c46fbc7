// Velocities of an estimator for positions that a test names, from the scene to the sample. Tests
// only.
#pragma once

#include <cstddef>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/estimator/estimator.h"
#include "core/scene.h"
#include "core/scene_keys.h"
#include "tests/position_bench.h"

namespace hapticwall::testing {

// 2 kHz, so that no test takes a rate of 1000 for granted.
inline Scene estimator_scene(std::string_view name, std::string_view key, double value) {
  Scene scene;
  scene.sampling.rate_hz = 2000.0;
  scene.x().walls = {{.position_m = 0.0, .stiffness_n_per_m = 0.0, .damping_n_s_per_m = 2.0}};
  scene.estimator.index = find_estimator(name).value();
  if (!key.empty())
    find_scene_number(scene, "estimator." + std::string(key)).value().set(scene, value);
  if (const auto problem = validate(scene)) throw std::runtime_error(problem->message);
  return scene;
}

inline std::vector<double> velocities(const Scene& scene, std::span<const double> positions_m) {
  PositionBench bench(servo_settings(scene));
  std::vector<double> velocities_m_per_s;
  for (const double position_m : positions_m)
    velocities_m_per_s.push_back(bench.move_to(position_m).velocity_m_per_s);
  return velocities_m_per_s;
}

// A walk in counts: rests, creeps, runs and turns.
inline std::vector<int> wandering_counts(std::size_t ticks) {
  std::mt19937 random(7);
  std::vector<int> counts{100};
  int speed = 0;
  while (counts.size() < ticks) {
    if (random() % 12 == 0) speed = static_cast<int>(random() % 9) - 4;
    const int shake = static_cast<int>(random() % 3) - 1;
    counts.push_back(counts.back() + speed + shake);
  }
  return counts;
}

inline std::vector<double> positions_of(std::span<const int> counts, double count_m) {
  std::vector<double> positions_m;
  for (const int count : counts) positions_m.push_back(count * count_m);
  return positions_m;
}

}  // namespace hapticwall::testing
