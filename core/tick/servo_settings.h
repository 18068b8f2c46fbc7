// The loop's part of a scene.
#pragma once

#include <cstdint>
#include <limits>

#include "core/algorithm/algorithm.h"
#include "core/chance.h"
#include "core/environment/environment.h"
#include "core/environment/walls.h"
#include "core/estimator/estimator.h"
#include "core/scene.h"

namespace hapticwall {

// An older position gives zero force.
inline constexpr double kDefaultMaxAgeS = 0.02;
// A switch of algorithm during a run blends the force over this time.
inline constexpr double kSwitchTransitionS = 0.05;

// The ticks on which the controller does not compute, so that its force stays.
struct SkippedTicks {
  std::uint64_t render_every = 1;
  double lost_share = 0.0;
  int seed = 1;

  [[nodiscard]] bool any() const { return render_every > 1 || lost_share > 0.0; }
  [[nodiscard]] bool has(std::uint64_t tick) const {
    return tick % render_every != 0 ||
           (lost_share > 0.0 && Chance(seed, 0, Purpose::kLostTick).uniform(tick) < lost_share);
  }
  friend bool operator==(const SkippedTicks&, const SkippedTicks&) = default;
};

// The loop's part of a scene. Trivially copyable.
struct ServoSettings {
  double rate_hz = 1000.0;
  SkippedTicks skipped;
  double device_damping_n_s_per_m = 0.0;
  double encoder_m = 0.0;  // 0: none
  double force_limit_n =
      std::numeric_limits<double>::max();  // finite, so that an infinite force is over it
  // Max rise of the force's magnitude in a tick.
  double max_rise_n = std::numeric_limits<double>::infinity();
  double maximum_age_s = kDefaultMaxAgeS;
  double transition_s = kSwitchTransitionS;
  WallSet walls;
  std::uint32_t axis = 0;                    // 0: x, 1: y
  const Environment* environment = nullptr;  // nullptr: the walls
  EnvironmentSettings environment_settings;
  const Estimator* estimator = nullptr;  // nullptr: the backward difference
  EstimatorSettings estimator_settings;
  AlgorithmSettings algorithm;
  // The axes of a scene with two need each other at every tick: they tick together.
  bool both_axes = false;

  [[nodiscard]] double period_s() const { return 1.0 / rate_hz; }
  [[nodiscard]] double render_rate_hz() const {
    return rate_hz / static_cast<double>(skipped.render_every);
  }
  // A loop in the walls of the scene that computes in every tick; servo_step() computes it inline.
  [[nodiscard]] bool plain() const { return !skipped.any() && environment == nullptr; }
  friend bool operator==(const ServoSettings&, const ServoSettings&) = default;
};

// Axis x of a scene; without a force limit the largest finite double. Realtime-safe: yes.
[[nodiscard]] ServoSettings servo_settings(const Scene& scene);
// Points into `settings`, which must outlive it. Realtime-safe: yes.
[[nodiscard]] AlgorithmContext algorithm_context(const ServoSettings& settings);

}  // namespace hapticwall
