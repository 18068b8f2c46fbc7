#include "core/scene.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/algorithm/algorithm.h"
#include "core/environment/environment.h"
#include "core/estimator/estimator.h"
#include "core/scene_keys.h"

namespace hapticwall {
namespace {

using Problem = std::optional<SceneProblem>;

// A week at 10 kHz has 6e9 ticks; a longer run is a mistake.
constexpr double kMaxTicks = 1e10;

Problem check_range(const std::string& key, double value, const ValueRange& range,
                    std::string_view unit) {
  if (range.contains(value)) return std::nullopt;
  return SceneProblem{key, out_of_range_text(value, range, unit)};
}

Problem check_numbers(const Scene& scene) {
  Problem problem;
  visit_scene_numbers(scene, [&](const NumberPath& path, const auto& key, const auto& owner) {
    const std::optional<double> value = key.get(owner);
    if (problem || !value || key.range.contains(*value)) return;
    problem = SceneProblem{path.text(), out_of_range_text(*value, key.range, key.unit)};
  });
  return problem;
}

// Smaller values other than 0 are below the resolution of a double position, force or tick.
constexpr double kMinEncoderM = 1e-12;
constexpr double kMinForceN = 1e-12;
constexpr double kMinTimeConstantS = 1e-9;

Problem check_fineness(const std::string& key, std::optional<double> value, double finest,
                       std::string_view unit) {
  if (value.value_or(0.0) == 0.0 || *value >= finest) return std::nullopt;
  return SceneProblem{key, number_text(*value) + " is too fine; it takes 0 (none) or " +
                               number_text(finest) + " " + std::string(unit) + " and more"};
}

Problem check_static_friction(const std::string& prefix, const DeviceSettings& device) {
  const std::string key = prefix + "static_friction_n";
  const double static_n = device.static_friction_n.value_or(0.0);
  if (static_n > 0.0 && !device.stribeck_speed_m_per_s) {
    return SceneProblem{key,
                        "it falls with the speed: " + prefix + "stribeck_speed_m_per_s is missing"};
  }
  if (static_n > 0.0 && static_n < device.friction_n.value_or(0.0)) {
    return SceneProblem{key, number_text(static_n) + " is less than " + prefix + "friction_n"};
  }
  return std::nullopt;
}

// `prefix`: "device." or "device.y."
Problem check_device(const std::string& prefix, const DeviceSettings& device) {
  for (const auto& [key, value, finest, unit] :
       {std::tuple("encoder_m", device.encoder_m, kMinEncoderM, "m"),
        std::tuple("force_resolution_n", device.force_resolution_n, kMinForceN, "N"),
        std::tuple("amplifier_time_constant_s", device.amplifier_time_constant_s, kMinTimeConstantS,
                   "s")}) {
    if (auto problem = check_fineness(prefix + key, value, finest, unit)) return problem;
  }
  return check_static_friction(prefix, device);
}

// The text of a key takes longer than the checks: only a problem has one.
Problem check_points(const std::string& key, const SharedPath& path) {
  const PathPoint* before = nullptr;
  for (const PathPoint& point : path) {
    const bool in_range =
        kPathTimeRange.contains(point.time_s) && kPositionRange.contains(point.position_m);
    if (in_range && (before == nullptr || point.time_s > before->time_s)) {
      before = &point;
      continue;
    }
    const std::string name = key + "[" + std::to_string(&point - &path.front()) + "]";
    if (auto problem = check_range(name, point.time_s, kPathTimeRange, "s")) return problem;
    if (auto problem = check_range(name, point.position_m, kPositionRange, "m")) return problem;
    return SceneProblem{name, "times must increase from point to point"};
  }
  return std::nullopt;
}

Problem check_path(const std::string& key, const HandSettings& hand) {
  if (hand.follows_mouse) {
    if (hand.path.empty()) return std::nullopt;
    return SceneProblem{key, "a hand that follows the mouse has no points"};
  }
  if (hand.path.empty())
    return SceneProblem{key, "missing; it takes points [[time s, position m], …]"};
  if (hand.path.file.empty() && hand.path.size() > kMaxPathPoints) {
    return SceneProblem{key, "has " + std::to_string(hand.path.size()) + " points; at most " +
                                 std::to_string(kMaxPathPoints) + " are taken"};
  }
  return check_points(key, hand.path);
}

// `prefix`: "hand." or "hand.y."
Problem check_hand(const std::string& prefix, const HandSettings& hand) {
  if (hand.has_grip() && !hand.mass_kg) {
    return SceneProblem{
        prefix + "grip_stiffness_n_per_m",
        "a grip holds the handle with a hand's mass: " + prefix + "mass_kg is missing"};
  }
  if (hand.grip_damping_n_s_per_m && !hand.has_grip()) {
    return SceneProblem{prefix + "grip_damping_n_s_per_m",
                        "a grip needs its spring: " + prefix + "grip_stiffness_n_per_m is missing"};
  }
  return check_path(prefix + "path", hand);
}

Problem check_wall_counts(const Scene& scene) {
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    const std::size_t count = scene.axes[i].walls.size();
    if (count <= kMaxWalls) continue;
    const std::string axis = !scene.two_axes() ? "" : i == 0 ? " on axis x" : " on axis y";
    return SceneProblem{"wall", std::to_string(count) + " walls" + axis + "; at most " +
                                    std::to_string(kMaxWalls) + " are taken"};
  }
  return std::nullopt;
}

// The pieces of a recorded hand are in ticks.
Problem check_recorded_rate(const Scene& scene) {
  for (const AxisSettings& axis : scene.axes) {
    if (!axis.hand || !axis.hand->path.recorded) continue;
    const double rate_hz = axis.hand->path.recorded->rate_hz;
    if (rate_hz == scene.sampling.rate_hz) continue;
    return SceneProblem{"sampling.rate_hz", "the hand was recorded at " + number_text(rate_hz) +
                                                " Hz, and is re-run at no other rate"};
  }
  return std::nullopt;
}

Problem check_axes(const Scene& scene) {
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    const AxisSettings& axis = scene.axes[i];
    if (auto problem = check_device(axis_key("device", i) + ".", axis.device)) return problem;
    if (!axis.hand) continue;
    if (auto problem = check_hand(axis_key("hand", i) + ".", *axis.hand)) return problem;
  }
  return check_wall_counts(scene);
}

std::string choice_text(const ParameterDescription& parameter) {
  std::string text;
  for (const std::string_view choice : parameter.choices) {
    if (!text.empty()) text += ", ";
    text += choice;
  }
  return text;
}

// `prefix`: "environment.", "algorithm." or "estimator.".
Problem check_parameters(std::string_view prefix, std::span<const ParameterDescription> parameters,
                         std::span<const std::optional<double>> values) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!values[i]) continue;
    const ParameterDescription& parameter = parameters[i];
    const std::string key = std::string(prefix).append(parameter.key);
    const ValueRange range{parameter.minimum, parameter.maximum};
    if (parameter.kind == ParameterKind::kChoice && !range.contains(*values[i])) {
      return SceneProblem{key, "it takes one of " + choice_text(parameter)};
    }
    if (auto problem = check_range(key, *values[i], range, parameter.unit)) return problem;
  }
  return std::nullopt;
}

Problem check_algorithm(const Scene& scene, const AxisSettings& axis) {
  const AlgorithmSettings& settings = scene.algorithm;
  if (settings.index >= algorithms().size()) {
    return SceneProblem{"algorithm.name", "there is no such algorithm"};
  }
  if (auto problem = check_parameters("algorithm.", algorithm_parameters(), settings.values))
    return problem;
  AlgorithmContext context;
  context.settings = &settings;
  context.device_damping_n_s_per_m = axis.device.damping_n_s_per_m;
  context.period_s = 1.0 / scene.sampling.render_rate_hz();
  for (const AlgorithmDescription& algorithm : algorithms()) {
    if (algorithm.problem == nullptr) continue;
    if (auto problem = algorithm.problem(context)) return problem;
  }
  return std::nullopt;
}

Problem check_estimator(const EstimatorSettings& settings) {
  if (settings.index >= estimators().size()) {
    return SceneProblem{"estimator.name", "there is no such estimator"};
  }
  return check_parameters("estimator.", estimator_parameters(), settings.values);
}

Problem check_walls_of(const Scene& scene) {
  if (scene.environment.is_walls()) return std::nullopt;
  for (const AxisSettings& axis : scene.axes) {
    if (axis.walls.empty()) continue;
    const EnvironmentDescription& taken = environments()[scene.environment.index].description;
    return SceneProblem{"wall", "the environment " + std::string(taken.name) +
                                    " takes the place of the walls: the scene takes none"};
  }
  return std::nullopt;
}

// The algorithm takes the environment for a spring.
Problem check_stiffness(const Scene& scene) {
  const Environment& environment = environments()[scene.environment.index];
  const AlgorithmDescription& algorithm = algorithms()[scene.algorithm.index];
  if (!algorithm.needs_stiffness || environment.has_stiffness_hint) return std::nullopt;
  return SceneProblem{"algorithm.name", std::string(algorithm.name) +
                                            " needs the stiffness of what is touched, and the "
                                            "environment " +
                                            std::string(environment.description.name) +
                                            " tells none: choose another algorithm"};
}

Problem check_environment(const Scene& scene) {
  const EnvironmentSettings& settings = scene.environment;
  if (settings.index >= environments().size()) {
    return SceneProblem{"environment.name", "there is no such environment"};
  }
  if (auto problem = check_parameters("environment.", environment_parameters(), settings.values))
    return problem;
  const EnvironmentContext context{1.0 / scene.sampling.render_rate_hz(), &settings};
  for (const Environment& environment : environments()) {
    if (environment.problem == nullptr) continue;
    if (auto problem = environment.problem(context)) return problem;
  }
  if (auto problem = check_walls_of(scene)) return problem;
  return check_stiffness(scene);
}

Problem check_simulator(const Scene& scene) {
  const SimulatorSettings& simulator = scene.simulator;
  const std::string key = "simulator.substeps";
  if (simulator.substeps < 1 || simulator.substeps > kMaxSubsteps) {
    return SceneProblem{key, std::to_string(simulator.substeps) +
                                 " is out of range; it takes 1 to " + std::to_string(kMaxSubsteps)};
  }
  if (simulator.integrator == Integrator::kExact && simulator.substeps != 1) {
    return SceneProblem{key, "the exact integrator has no substeps: it takes 1"};
  }
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    if (simulator.integrator != Integrator::kExact) break;
    if (scene.axes[i].device.static_friction_n.value_or(0.0) == 0.0) continue;
    return SceneProblem{axis_key("device", i) + ".static_friction_n",
                        "the exact integrator has Coulomb friction alone: it takes "
                        "simulator.integrator = \"rk4\" or \"semi-implicit-euler\""};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Integrator> find_integrator(std::string_view name) {
  const auto found = std::find(kIntegratorNames.begin(), kIntegratorNames.end(), name);
  if (found == kIntegratorNames.end()) return std::nullopt;
  return static_cast<Integrator>(std::distance(kIntegratorNames.begin(), found));
}

bool same_plant(const Scene& a, const Scene& b) {
  return a.x().device == b.x().device && a.x().hand == b.x().hand && a.simulator == b.simulator;
}

bool couples_axes(const Scene& scene) {
  return scene.two_axes() && (!scene.environment.is_walls() || reads_other_axis(scene.algorithm));
}

Scene axis_scene(const Scene& scene, std::size_t index) {
  Scene axis = scene;
  axis.axes = {scene.axes[index]};
  axis.first_axis = scene.first_axis + index;
  return axis;
}

Scene without_paths(Scene scene) {
  for (AxisSettings& axis : scene.axes) {
    if (axis.hand) axis.hand->path = {};
  }
  return scene;
}

std::uint64_t Scene::tick_count() const {
  return static_cast<std::uint64_t>(std::max(1.0, std::round(duration_s * sampling.rate_hz)));
}

Problem validate(const Scene& scene) {
  if (auto problem = check_numbers(scene)) return problem;
  if (scene.duration_s * scene.sampling.rate_hz > kMaxTicks) {
    return SceneProblem{"duration_s", "gives more than " + number_text(kMaxTicks) + " ticks"};
  }
  if (auto problem = check_axes(scene)) return problem;
  if (auto problem = check_recorded_rate(scene)) return problem;
  for (const AxisSettings& axis : scene.axes) {
    if (auto problem = check_algorithm(scene, axis)) return problem;
  }
  if (auto problem = check_estimator(scene.estimator)) return problem;
  if (auto problem = check_environment(scene)) return problem;
  return check_simulator(scene);
}

}  // namespace hapticwall
