// What a scene names: a device, a hand, walls, an algorithm. Plain values in SI units; the ranges
// of every key live in scene_keys.h, the contradictions between keys in validate().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/stabiliser/algorithm_settings.h"

namespace hapticwall {

struct SamplingSettings {
  double rate_hz = 1000.0;

  [[nodiscard]] double period_s() const { return 1.0 / rate_hz; }
};

// An output is delayed by at most this many ticks.
inline constexpr int kMaximumDelayTicks = 1000;

// One axis of the haptic device. An absent optional is a part that the model leaves out.
struct DeviceSettings {
  double mass_kg = 0.05;
  double damping_n_s_per_m = 1.0;
  std::optional<double> friction_n;
  std::optional<double> encoder_m;
  std::optional<double> force_limit_n;
  // What lies between a command and the force on the handle: rounding to whole steps of force, a
  // delay of whole ticks, and an amplifier that follows as a first-order lag.
  std::optional<double> force_resolution_n;
  std::optional<int> delay_ticks;
  std::optional<double> amplifier_time_constant_s;
  double start_m = 0.03;

  friend bool operator==(const DeviceSettings&, const DeviceSettings&) = default;
};

struct PathPoint {
  double time_s = 0.0;
  double position_m = 0.0;

  friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

// The hand: a spring-damper to an intended path. With a mass and no grip, the mass is joined
// rigidly to the handle; with a mass and a grip, it holds the handle through the grip's
// spring-damper.
struct HandSettings {
  std::optional<double> mass_kg;
  double stiffness_n_per_m = 0.0;
  double damping_n_s_per_m = 0.0;
  std::optional<double> grip_stiffness_n_per_m;
  std::optional<double> grip_damping_n_s_per_m;
  std::vector<PathPoint> path;
  // The pointer in the window leads the hand (`path = "mouse"`); `path` is then empty.
  bool follows_mouse = false;

  [[nodiscard]] bool has_grip() const { return grip_stiffness_n_per_m.has_value(); }
  friend bool operator==(const HandSettings&, const HandSettings&) = default;
};

struct WallSettings {
  double position_m = 0.05;
  double stiffness_n_per_m = 0.0;
  double damping_n_s_per_m = 0.0;

  friend bool operator==(const WallSettings&, const WallSettings&) = default;
};

// How the simulator moves the handle between two ticks.
enum class Integrator : std::uint8_t { kExact, kSemiImplicitEuler, kRungeKutta4 };

// The words of the scene file, in the order of Integrator.
inline constexpr std::array<std::string_view, 3> kIntegratorNames{"exact", "semi-implicit-euler",
                                                                  "rk4"};
inline constexpr int kMaximumSubsteps = 1000;

struct SimulatorSettings {
  Integrator integrator = Integrator::kExact;
  int substeps = 1;  // per tick, 1 to kMaximumSubsteps; the exact integrator needs none and takes 1

  [[nodiscard]] std::string_view integrator_name() const {
    return kIntegratorNames.at(static_cast<std::size_t>(integrator));
  }
  friend bool operator==(const SimulatorSettings&, const SimulatorSettings&) = default;
};

[[nodiscard]] std::optional<Integrator> find_integrator(std::string_view name);

inline constexpr std::size_t kMaximumWalls = 8;  // on an axis

// The second axis of a corner: a handle, a hand and walls of its own. It is a loop of its own too;
// rate, duration, algorithm and integrator are those of the scene.
struct SecondAxis {
  DeviceSettings device;
  std::optional<HandSettings> hand;
  std::vector<WallSettings> walls;

  friend bool operator==(const SecondAxis&, const SecondAxis&) = default;
};

struct Scene {
  std::string name;
  std::string description;
  double duration_s = 6.0;
  SamplingSettings sampling;
  DeviceSettings device;
  std::optional<HandSettings> hand;
  std::vector<WallSettings> walls;
  std::optional<SecondAxis> y;  // device, hand and walls above are those of axis x
  AlgorithmSettings algorithm;
  SimulatorSettings simulator;

  // Number of ticks of a headless run: round(duration * rate), at least 1.
  [[nodiscard]] std::uint64_t tick_count() const;
};

// Axis y as a scene of one axis. Precondition: scene.y. Realtime-safe: no.
[[nodiscard]] Scene second_axis(const Scene& scene);

// True where both have the same plant on axis x: where two scenes of a session differ in this, the
// plant changes.
[[nodiscard]] bool same_plant(const Scene& a, const Scene& b);

// One thing that is wrong with a scene: the dotted key and a sentence that says what would be
// right.
struct SceneProblem {
  std::string key;
  std::string message;
};

// The first problem of a scene (a value out of range, or a contradiction), or nothing.
// Realtime-safe: no.
[[nodiscard]] std::optional<SceneProblem> validate(const Scene& scene);

}  // namespace hapticwall
