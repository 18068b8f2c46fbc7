// Random scenes at the extremes of every key, by number: the same number gives the same scene on
// every machine, so that a failure names a scene that can be looked at.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/scene.h"
#include "core/tick/servo_step.h"
#include "tests/position_bench.h"

namespace hapticwall::testing {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}

  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * fraction(); }
  // Logarithmically uniform.
  [[nodiscard]] double log_uniform(double low, double high) {
    return std::clamp(low * std::pow(high / low, fraction()), low, high);
  }
  [[nodiscard]] bool chance(double probability) { return fraction() < probability; }
  // One in five is 0.
  [[nodiscard]] double zero_or(double low, double high) {
    return chance(0.2) ? 0.0 : log_uniform(low, high);
  }
  // 0 … count - 1.
  [[nodiscard]] std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(engine_() % count);
  }

 private:
  [[nodiscard]] double fraction() {
    constexpr int kUnusedBits = 11;
    return std::ldexp(static_cast<double>(engine_() >> kUnusedBits), kUnusedBits - 64);
  }
  std::mt19937_64 engine_;
};

// Limits on motion that takes real time in the exact integrator: a swing that friction stops at
// each turn, a grip that swings or creeps under friction, and the parts of a tick where a grip
// swings through it. A scene may have this many radians (or time constants) in all.
inline constexpr double kMaxSwingsWithFriction = 2e4;
inline constexpr double kMaxSwingsWithGrip = 2e7;
inline constexpr double kMaxTicks = 300.0;

// Points about `centre_m`: equal ones, ones that differ in the last digit or in the denormals,
// steps within 1e-15 s, and moves as far as a hand reaches.
inline std::vector<PathPoint> extreme_path(Draw& draw, double centre_m, double duration_s) {
  std::vector<PathPoint> path;
  double time_s = draw.chance(0.5) ? 0.0 : draw.uniform(0.0, 0.3 * duration_s);
  double position_m = centre_m + (draw.chance(0.5) ? 0.0 : draw.uniform(-5e-4, 5e-4));
  const std::size_t points = 1 + draw.index(4);
  while (path.size() < points) {
    path.push_back({time_s, position_m});
    const double later_s =
        time_s + draw.log_uniform(draw.chance(0.2) ? 1e-15 : 1e-3, 1.0) * std::min(duration_s, 1.0);
    if (!(later_s > time_s)) break;
    time_s = later_s;
    switch (draw.index(5)) {
      case 0:
        break;
      case 1:
        position_m += draw.log_uniform(1e-320, 1e-200);
        break;
      case 2:
      case 3:
        position_m += draw.uniform(-0.5, 0.5) * draw.log_uniform(1e-15, 0.05);
        position_m = std::clamp(position_m, -1.0, 1.0);
        break;
      default:
        position_m = draw.uniform(0.0, 0.1);
    }
  }
  return path;
}

inline HandSettings extreme_hand(Draw& draw, double centre_m, double duration_s) {
  HandSettings hand;
  hand.stiffness_n_per_m = draw.zero_or(1e-6, 1e9);
  hand.damping_n_s_per_m = draw.chance(0.4) ? 0.0 : draw.log_uniform(1e-6, 1e4);
  if (draw.chance(0.5)) {
    hand.mass_kg = draw.log_uniform(1e-6, 1e3);
    if (draw.chance(0.6)) {
      hand.grip_stiffness_n_per_m = draw.zero_or(1e-6, 1e9);
      if (draw.chance(0.5)) hand.grip_damping_n_s_per_m = draw.zero_or(1e-6, 1e4);
    }
  }
  hand.path = extreme_path(draw, centre_m, duration_s);
  return hand;
}

inline void draw_device(Draw& draw, DeviceSettings& device) {
  device.mass_kg = draw.log_uniform(1e-6, 1e3);
  device.damping_n_s_per_m = draw.zero_or(1e-6, 1e4);
  device.start_m = draw.chance(0.25) ? 0.0 : draw.chance(0.9) ? 0.03 : draw.uniform(-1.0, 1.0);
  if (draw.chance(0.3)) device.friction_n = draw.zero_or(1e-6, 10.0);
  if (draw.chance(0.5)) device.encoder_m = draw.zero_or(1e-9, 0.01);
  if (draw.chance(0.8)) device.force_limit_n = draw.zero_or(1e-3, 1e6);
  if (draw.chance(0.3)) device.force_resolution_n = draw.zero_or(1e-12, 1e3);
  if (draw.chance(0.3)) {
    device.delay_ticks = draw.chance(0.2) ? 0 : static_cast<int>(draw.log_uniform(1.0, 1000.0));
  }
  if (draw.chance(0.3)) device.amplifier_time_constant_s = draw.zero_or(1e-9, 10.0);
}

// Parts that an ideal loop and device have not. Drawn last, so that the rest of a scene of this
// number stays. Uneven periods are the tests' to choose: the measure of the turnover has even ones.
inline void draw_departures(Draw& draw, Scene& scene) {
  if (draw.chance(0.2)) scene.sampling.render_every = 1 + static_cast<int>(draw.index(1000));
  if (draw.chance(0.2)) scene.sampling.lost_ticks = draw.zero_or(1e-6, 0.99);
  if (draw.chance(0.2)) scene.x().device.position_noise_m = draw.zero_or(1e-15, 0.01);
  if (draw.chance(0.2)) scene.x().device.force_noise_n = draw.zero_or(1e-12, 10.0);
}

inline void draw_walls(Draw& draw, double start_m, std::vector<WallSettings>& walls) {
  const std::size_t count = draw.index(4);
  while (walls.size() < count) {
    const double position_m = draw.chance(0.4)    ? 0.05
                              : draw.chance(0.5)  ? start_m
                              : draw.chance(0.25) ? (draw.chance(0.5) ? 1.0 : -1.0)
                                                  : draw.uniform(-1.0, 1.0);
    walls.push_back({.position_m = position_m,
                     .stiffness_n_per_m = draw.zero_or(1e-3, 1e9),
                     .damping_n_s_per_m = draw.chance(0.6) ? 0.0 : draw.log_uniform(1e-3, 1e4)});
  }
}

inline void draw_algorithm(Draw& draw, AlgorithmSettings& algorithm) {
  algorithm.index = draw.index(algorithms().size());
  const auto parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!draw.chance(0.2)) continue;
    const ParameterDescription& parameter = parameters[i];
    double value = 0.0;
    if (parameter.kind != ParameterKind::kNumber) {
      value = static_cast<double>(draw.index(static_cast<std::size_t>(parameter.maximum) + 1));
    } else if (draw.chance(0.7)) {
      value = draw.log_uniform(1e-6, parameter.maximum);
    } else {
      value = draw.chance(0.5) ? parameter.minimum : parameter.maximum;
    }
    algorithm.values.at(i) = value;
  }
  // A coupling's damper may exceed the believed b only where the stiffness is named too.
  auto& stiffness = algorithm.values.at(*find_algorithm_parameter("coupling_stiffness_n_per_m"));
  if (!stiffness) stiffness = draw.zero_or(1e-3, 1e9);
}

// Limits the storage stiffness to the max that the hold can carry, once device and rate are known.
inline void bound_storage(Scene& scene) {
  const auto index = *find_algorithm_parameter("storage_stiffness_n_per_m");
  auto& storage = scene.algorithm.values.at(index);
  if (!storage) return;
  const ServoSettings settings = servo_settings(scene);
  const double most = max_storage_stiffness(settings);
  storage = std::min(std::max(*storage, algorithm_parameters()[index].minimum), most);
  if (*storage < algorithm_parameters()[index].minimum) storage.reset();
}

// The fastest swing of the scene's springs, rad/s.
inline double fastest_swing_per_s(const Scene& scene) {
  if (!scene.x().hand) return 0.0;
  const HandSettings& hand = *scene.x().hand;
  if (!hand.has_grip()) return std::sqrt(hand.stiffness_n_per_m / scene.x().device.mass_kg);
  const double grip = *hand.grip_stiffness_n_per_m;
  return std::sqrt(2.0 * grip / scene.x().device.mass_kg +
                   (2.0 * grip + hand.stiffness_n_per_m) / *hand.mass_kg);
}

// The fastest decay by the scene's dampers, 1/s.
inline double fastest_decay_per_s(const Scene& scene) {
  const double damping = scene.x().device.damping_n_s_per_m;
  if (!scene.x().hand) return damping / scene.x().device.mass_kg;
  const HandSettings& hand = *scene.x().hand;
  if (!hand.has_grip()) return (damping + hand.damping_n_s_per_m) / scene.x().device.mass_kg;
  const double grip = hand.grip_damping_n_s_per_m.value_or(0.0);
  return std::max((damping + grip) / scene.x().device.mass_kg,
                  (hand.damping_n_s_per_m + grip) / *hand.mass_kg);
}

// If friction or a grip makes motion cost time, the tick or the run is made short enough.
inline void bound_cost(Scene& scene, double ticks) {
  const bool friction = scene.x().device.friction_n.value_or(0.0) > 0.0;
  const bool grip = scene.x().hand && scene.x().hand->has_grip();
  double rate_per_s = 0.0;
  double most = 0.0;  // max of the rate times the duration
  if (friction) {
    rate_per_s = fastest_swing_per_s(scene);
    most = kMaxSwingsWithFriction;
    if (grip) rate_per_s = std::max(rate_per_s, 0.1 * fastest_decay_per_s(scene));
  } else if (grip) {
    rate_per_s = fastest_swing_per_s(scene);
    most = kMaxSwingsWithGrip;
  }
  if (rate_per_s > most * scene.sampling.rate_hz) {
    scene.sampling.rate_hz = std::min(1e5, rate_per_s / most);
  }
  if (rate_per_s > 0.0) ticks = std::min(ticks, most * scene.sampling.rate_hz / rate_per_s);
  scene.duration_s = std::max(1.0, std::floor(ticks)) / scene.sampling.rate_hz;
}

// Valid whatever the number. The integrator and its substeps are the caller's to choose.
inline Scene extreme_scene(std::uint64_t number) {
  Draw draw(number);
  Scene scene;
  scene.name = "extreme";
  scene.sampling.rate_hz = draw.chance(0.5) ? 1000.0 : draw.log_uniform(10.0, 1e5);
  const double ticks = draw.chance(0.1) ? 1.0 : std::floor(draw.uniform(1.0, kMaxTicks));
  draw_device(draw, scene.x().device);
  draw_walls(draw, scene.x().device.start_m, scene.x().walls);
  if (draw.chance(0.85)) {
    scene.x().hand = extreme_hand(draw, scene.x().device.start_m, ticks / scene.sampling.rate_hz);
  }
  draw_algorithm(draw, scene.algorithm);
  bound_cost(scene, ticks);
  if (draw.chance(0.1)) scene.x().device.max_force_rate_n_per_s = draw.zero_or(1e-3, 1e9);
  draw_departures(draw, scene);
  bound_storage(scene);
  return scene;
}

}  // namespace hapticwall::testing
