// A scene: device, hand and walls of each axis, or another environment in the place of the walls;
// one algorithm and one velocity estimator. Plain values in SI units. scene_keys.h has the range of
// every number; validate() also finds contradictions between them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/algorithm_settings.h"
#include "core/environment_settings.h"
#include "core/estimator_settings.h"
#include "core/sample.h"

namespace hapticwall {

// Rate of the control loop, 10 Hz to 100 kHz. One period is a tick. The loop is ideal without the
// optional parts. The controller does not know of lost ticks and jitter: it computes with the
// nominal period.
struct SamplingSettings {
  double rate_hz = 1000.0;
  // The controller computes on every n-th tick, with n times the period; the device holds its force
  // until then. 1 to kMaxRenderEvery.
  std::optional<int> render_every;
  // Share of ticks, at random, on which the controller does not compute: the device holds its
  // force.
  std::optional<double> lost_ticks;
  // The simulator's periods are independent and uniform within 1 ± jitter of the nominal one.
  std::optional<double> jitter;
  // Of lost ticks, jitter and the device's noise; nullopt: 1.
  std::optional<int> seed;

  [[nodiscard]] double period_s() const { return 1.0 / rate_hz; }
  // Rate of the controller's computations.
  [[nodiscard]] double render_rate_hz() const { return rate_hz / render_every.value_or(1); }
  // True if the times of the controller's computations are random.
  [[nodiscard]] bool at_random() const {
    return lost_ticks.value_or(0.0) > 0.0 || jitter.value_or(0.0) > 0.0;
  }
  // Rate, jitter and seed, which stay the same during a session.
  [[nodiscard]] bool same_clock(const SamplingSettings& other) const {
    return rate_hz == other.rate_hz && jitter == other.jitter && seed == other.seed;
  }
  [[nodiscard]] SamplingSettings with_clock_of(const SamplingSettings& other) const {
    return {other.rate_hz, render_every, lost_ticks, other.jitter, other.seed};
  }
  friend bool operator==(const SamplingSettings&, const SamplingSettings&) = default;
};

inline constexpr int kMaxRenderEvery = 1000;
inline constexpr int kMaxDelayTicks = 1000;

// One axis of the haptic device. The model omits a part whose optional is empty.
struct DeviceSettings {
  // Moving mass of the device, without a hand.
  double mass_kg = 0.05;
  // Viscous damping, the b of the algorithms unless [algorithm] has a `damping_n_s_per_m`.
  double damping_n_s_per_m = 1.0;
  // Coulomb friction, equal in both directions. A handle at rest sticks within it.
  std::optional<double> friction_n;
  // Friction of a handle that breaks loose, at least friction_n: with the speed it falls to
  // friction_n as 1/(1 + (v/stribeck_speed)²). Not for the exact integrator.
  std::optional<double> static_friction_n;
  std::optional<double> stribeck_speed_m_per_s;
  // One count of the encoder, at least 1e-12 m; 0 and nullopt: the position is continuous.
  std::optional<double> encoder_m;
  // Standard deviations of noise that is new in every tick: of the position before the encoder
  // counts it, and of the force at the amplifier.
  std::optional<double> position_noise_m;
  std::optional<double> force_noise_n;
  // Limit of the magnitude of the force. nullopt: none.
  std::optional<double> force_limit_n;
  // Rate at which the magnitude of the command may rise; a fall is not limited. 0 and nullopt: any.
  std::optional<double> max_force_rate_n_per_s;
  // The force chain from the command to the handle: rounding to steps of force, a delay of whole
  // ticks (at most kMaxDelayTicks), and a first-order lag for the amplifier.
  std::optional<double> force_resolution_n;
  std::optional<int> delay_ticks;
  std::optional<double> amplifier_time_constant_s;
  double start_m = 0.03;
  // The stiffest and the most damped wall that CHAI3D's source sets for this device. No run changes
  // with them.
  std::optional<double> chai3d_stiffness_n_per_m;
  std::optional<double> chai3d_damping_n_s_per_m;

  friend bool operator==(const DeviceSettings&, const DeviceSettings&) = default;
};

// Times ascend from point to point. kPathTimeRange and kPositionRange (scene_keys.h) bound both.
struct PathPoint {
  double time_s = 0.0;
  double position_m = 0.0;

  friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

// A stretch of a recorded hand at constant speed, up to the next one. Times are in ticks.
struct PathPiece {
  double from_tick = 0.0;
  double begin_tick = 0.0;  // the position is of this instant, which may be earlier
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
};

// The hand of a recording as it moved, whoever led it. A scene takes it at the rate of the
// recording only.
struct RecordedPieces {
  double rate_hz = 1000.0;        // of the ticks
  std::vector<PathPiece> pieces;  // at least one; the first is from tick 0
};

// The intended path of a hand: straight between its points, constant before the first and after the
// last. Copies share the points, because a map copies its scene for every cell.
class SharedPath {
 public:
  SharedPath() = default;
  SharedPath(std::vector<PathPoint> points)  // NOLINT(google-explicit-constructor)
      : points_(std::make_shared<std::vector<PathPoint>>(std::move(points))) {}
  SharedPath(std::initializer_list<PathPoint> points) : SharedPath(std::vector(points)) {}

  [[nodiscard]] const std::vector<PathPoint>& points() const {
    static const std::vector<PathPoint> kNone;
    return points_ ? *points_ : kNone;
  }
  [[nodiscard]] bool empty() const { return points().empty() && !recorded; }
  [[nodiscard]] std::size_t size() const { return points().size(); }
  // Preconditions: index < size(), and not empty for front() and back().
  [[nodiscard]] const PathPoint& operator[](std::size_t index) const { return points()[index]; }
  [[nodiscard]] const PathPoint& front() const { return points().front(); }
  [[nodiscard]] const PathPoint& back() const { return points().back(); }
  [[nodiscard]] auto begin() const { return points().begin(); }
  [[nodiscard]] auto end() const { return points().end(); }

  // Points of its own and of no file, to change before the next copy. Copies all of them.
  [[nodiscard]] std::vector<PathPoint>& edit() {
    *this = SharedPath(points());
    return *points_;
  }

  // Absolute name and SHA-256 of the file that has the points (`path_file`), if there is one.
  std::string file{};
  std::string sha256{};

  // Motion of a recording in the place of points: the path then has none.
  std::shared_ptr<const RecordedPieces> recorded{};

  // True for the same motion; a file may move.
  friend bool operator==(const SharedPath& a, const SharedPath& b) {
    return a.recorded == b.recorded && (a.points_ == b.points_ || a.points() == b.points());
  }

 private:
  std::shared_ptr<std::vector<PathPoint>> points_;
};

// The hand follows an intended path through a spring-damper. Its mass, if any, is joined to the
// handle: rigidly without a grip, through the spring-damper of the grip with one.
struct HandSettings {
  std::optional<double> mass_kg;
  double stiffness_n_per_m = 0.0;
  double damping_n_s_per_m = 0.0;
  std::optional<double> grip_stiffness_n_per_m;
  std::optional<double> grip_damping_n_s_per_m;
  SharedPath path;
  // The pointer of the window leads the hand (`path = "mouse"`). Then `path` is empty.
  bool follows_mouse = false;

  [[nodiscard]] bool has_grip() const { return grip_stiffness_n_per_m.has_value(); }
  friend bool operator==(const HandSettings&, const HandSettings&) = default;
};

// A one-sided spring-damper from `position_m` on, towards larger positions. evaluate_walls()
// (core/environment/walls.h) has its force.
struct WallSettings {
  double position_m = 0.05;
  double stiffness_n_per_m = 0.0;
  double damping_n_s_per_m = 0.0;

  friend bool operator==(const WallSettings&, const WallSettings&) = default;
};

// How the simulator moves the handle between two ticks: in closed form, or by a method of first or
// of fourth order, whose errors a comparison needs.
enum class Integrator : std::uint8_t { kExact, kSemiImplicitEuler, kRungeKutta4 };

// Names in a scene file, in the order of Integrator.
inline constexpr std::array<std::string_view, 3> kIntegratorNames{"exact", "semi-implicit-euler",
                                                                  "rk4"};
inline constexpr int kMaxSubsteps = 1000;

struct SimulatorSettings {
  Integrator integrator = Integrator::kExact;
  int substeps = 1;  // per tick, 1 to kMaxSubsteps; 1 for the exact integrator

  [[nodiscard]] std::string_view integrator_name() const {
    return kIntegratorNames.at(static_cast<std::size_t>(integrator));
  }
  friend bool operator==(const SimulatorSettings&, const SimulatorSettings&) = default;
};

// nullopt for a name outside kIntegratorNames.
[[nodiscard]] std::optional<Integrator> find_integrator(std::string_view name);

inline constexpr std::size_t kMaxWalls = 8;  // on an axis

// One axis of motion. Every axis is a control loop by itself; rate, duration, algorithm, estimator
// and integrator belong to the scene.
struct AxisSettings {
  DeviceSettings device;
  std::optional<HandSettings> hand;
  std::vector<WallSettings> walls;

  friend bool operator==(const AxisSettings&, const AxisSettings&) = default;
};

struct Scene {
  std::string name;
  std::string description;
  // Duration of a headless run, greater than 0 and at most 1e6 s and 1e10 ticks.
  double duration_s = 6.0;
  SamplingSettings sampling;
  std::vector<AxisSettings> axes = std::vector<AxisSettings>(1);  // x, or x and y
  // Of all axes. Another one than the walls takes their place: the axes then have none.
  EnvironmentSettings environment;
  AlgorithmSettings algorithm;
  EstimatorSettings estimator;
  SimulatorSettings simulator;
  // Place of the first axis in the scene that axis_scene() took it from: axes differ in noise.
  std::size_t first_axis = 0;

  [[nodiscard]] AxisSettings& x() { return axes.front(); }
  [[nodiscard]] const AxisSettings& x() const { return axes.front(); }
  [[nodiscard]] bool two_axes() const { return axes.size() > 1; }

  // Number of ticks of a headless run: round(duration * rate), at least 1.
  [[nodiscard]] std::uint64_t tick_count() const;
  friend bool operator==(const Scene&, const Scene&) = default;
};

// A change of parameters during a session, in force from `tick` on. Sampling rate, jitter, seed,
// duration, start and path of the hand stay those of the first scene. The handle keeps its state.
struct ScheduledChange {
  std::uint64_t tick = 0;
  Scene scene;
};

// True if the axes need each other at every tick: an environment that both share, or an algorithm
// that acts on both. Realtime-safe: yes.
[[nodiscard]] bool couples_axes(const Scene& scene);

// One axis as a scene by itself. Precondition: index < scene.axes.size(). Realtime-safe: no.
[[nodiscard]] Scene axis_scene(const Scene& scene, std::size_t index);

// The scene with an empty path for every hand. Realtime-safe: no.
[[nodiscard]] Scene without_paths(Scene scene);

// True if axis x has the same plant in both scenes: equal device, hand, path and simulator. Walls,
// algorithm and rate do not count.
[[nodiscard]] bool same_plant(const Scene& a, const Scene& b);

// An error in a scene: the dotted key, such as "wall[1].stiffness_n_per_m", and a message that says
// what the key takes.
struct SceneProblem {
  std::string key;
  std::string message;
};

// The first problem of a scene: a number out of range, or a contradiction. nullopt if it is valid.
// Realtime-safe: no.
[[nodiscard]] std::optional<SceneProblem> validate(const Scene& scene);

}  // namespace hapticwall
