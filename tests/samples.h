// The samples of a headless run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/run/simulate.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::testing {

inline std::vector<Sample> samples_of(
    const Scene& scene, std::span<const ScheduledChange> changes = {},
    SimulationResult (*run)(const Scene&, const SimulationOptions&) = simulate) {
  std::vector<Sample> samples;
  SimulationOptions options;
  options.changes = changes;
  options.signals = true;
  options.on_sample = [&](const Sample& sample) { samples.push_back(sample); };
  static_cast<void>(run(scene, options));
  return samples;
}

// The largest difference of the true positions, metres. Precondition: as many of both.
inline double max_distance_m(const std::vector<Sample>& a, const std::vector<Sample>& b) {
  double distance_m = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    distance_m = std::max(distance_m, std::abs(a[i].truth.position_m - b[i].truth.position_m));
  }
  return distance_m;
}

}  // namespace hapticwall::testing
