#include "core/scene.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/scene_keys.h"
#include "core/stabiliser/energy_bounding_2010.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall {
namespace {

using Problem = std::optional<SceneProblem>;

// A run of more ticks than this is a mistake (a week at 10 kHz has fewer).
constexpr double kMaximumTicks = 1e10;

std::string range_text(const ValueRange& range, std::string_view unit) {
  std::string text = range.minimum_excluded
                         ? "more than " + number_text(range.minimum) + ", at most "
                         : number_text(range.minimum) + " to ";
  text += number_text(range.maximum);
  if (!unit.empty()) text += " " + std::string(unit);
  return text;
}

Problem check_range(const std::string& key, double value, const ValueRange& range,
                    std::string_view unit) {
  if (range.contains(value)) return std::nullopt;
  return SceneProblem{key,
                      number_text(value) + " is out of range; it takes " + range_text(range, unit)};
}

template <typename Owner>
Problem check_table(const std::string& prefix, const Owner& owner,
                    std::span<const NumberKey<Owner>> keys) {
  for (const NumberKey<Owner>& key : keys) {
    const std::optional<double> value = key.get(owner);
    if (!value) continue;
    if (auto problem = check_range(prefix + std::string(key.key), *value, key.range, key.unit)) {
      return problem;
    }
  }
  return std::nullopt;
}

// Finer than this, and not 0, is beyond the digits of a position, a force or a tick.
constexpr double kFinestEncoderM = 1e-12;
constexpr double kFinestForceN = 1e-12;
constexpr double kShortestTimeConstantS = 1e-9;

Problem check_fineness(const std::string& key, std::optional<double> value, double finest,
                       std::string_view unit) {
  if (value.value_or(0.0) == 0.0 || *value >= finest) return std::nullopt;
  return SceneProblem{key, number_text(*value) + " is too fine; it takes 0 (none) or " +
                               number_text(finest) + " " + std::string(unit) + " and more"};
}

// `prefix`: "device." or "device.y."
Problem check_device(const std::string& prefix, const DeviceSettings& device) {
  if (auto problem = check_table<DeviceSettings>(prefix, device, device_number_keys())) {
    return problem;
  }
  if (auto problem = check_fineness(prefix + "encoder_m", device.encoder_m, kFinestEncoderM, "m")) {
    return problem;
  }
  if (auto problem = check_fineness(prefix + "force_resolution_n", device.force_resolution_n,
                                    kFinestForceN, "N")) {
    return problem;
  }
  return check_fineness(prefix + "amplifier_time_constant_s", device.amplifier_time_constant_s,
                        kShortestTimeConstantS, "s");
}

Problem check_path(const std::string& key, const HandSettings& hand) {
  if (hand.follows_mouse) {
    if (hand.path.empty()) return std::nullopt;
    return SceneProblem{key, "a hand that follows the mouse has no points"};
  }
  if (hand.path.empty())
    return SceneProblem{key, "missing; it takes points [[time s, position m], …]"};
  if (hand.path.size() > kMaximumPathPoints) {
    return SceneProblem{key, "has " + std::to_string(hand.path.size()) + " points; at most " +
                                 std::to_string(kMaximumPathPoints) + " are taken"};
  }
  for (std::size_t i = 0; i < hand.path.size(); ++i) {
    const std::string point = key + "[" + std::to_string(i) + "]";
    if (auto problem = check_range(point, hand.path[i].time_s, kPathTimeRange, "s")) return problem;
    if (auto problem = check_range(point, hand.path[i].position_m, kPositionRange, "m")) {
      return problem;
    }
    if (i > 0 && !(hand.path[i].time_s > hand.path[i - 1].time_s)) {
      return SceneProblem{point, "times must increase from point to point"};
    }
  }
  return std::nullopt;
}

// `prefix`: "hand." or "hand.y."
Problem check_hand(const std::string& prefix, const HandSettings& hand) {
  if (auto problem = check_table<HandSettings>(prefix, hand, hand_number_keys())) return problem;
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

Problem check_wall_count(std::string_view axis, std::size_t count) {
  if (count <= kMaximumWalls) return std::nullopt;
  return SceneProblem{"wall", std::to_string(count) + " walls" + std::string(axis) + "; at most " +
                                  std::to_string(kMaximumWalls) + " are taken"};
}

// Walls are counted as a scene is written: those of axis x first.
Problem check_walls(const Scene& scene) {
  if (auto problem = check_wall_count(scene.y ? " on axis x" : "", scene.walls.size())) {
    return problem;
  }
  std::vector<WallSettings> walls = scene.walls;
  if (scene.y) {
    if (auto problem = check_wall_count(" on axis y", scene.y->walls.size())) return problem;
    walls.insert(walls.end(), scene.y->walls.begin(), scene.y->walls.end());
  }
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const std::string prefix = walls.size() == 1 ? "wall." : "wall[" + std::to_string(i) + "].";
    if (auto problem = check_table<WallSettings>(prefix, walls[i], wall_number_keys())) {
      return problem;
    }
  }
  return std::nullopt;
}

Problem check_second_axis(const Scene& scene) {
  if (!scene.y) return std::nullopt;
  if (auto problem = check_device("device.y.", scene.y->device)) return problem;
  if (!scene.y->hand) return std::nullopt;
  return check_hand("hand.y.", *scene.y->hand);
}

std::string choice_text(const ParameterDescription& parameter) {
  std::string text;
  for (const std::string_view choice : parameter.choices) {
    if (!text.empty()) text += ", ";
    text += choice;
  }
  return text;
}

Problem check_algorithm(const Scene& scene) {
  const AlgorithmSettings& settings = scene.algorithm;
  if (settings.index >= algorithms().size()) {
    return SceneProblem{"algorithm.name", "there is no such algorithm"};
  }
  const auto parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!settings.values[i]) continue;
    const ParameterDescription& parameter = parameters[i];
    const std::string key = "algorithm." + std::string(parameter.key);
    const ValueRange range{parameter.minimum, parameter.maximum};
    if (parameter.kind == ParameterKind::kChoice && !range.contains(*settings.values[i])) {
      return SceneProblem{key, "it takes one of " + choice_text(parameter)};
    }
    if (auto problem = check_range(key, *settings.values[i], range, parameter.unit)) return problem;
  }
  StabiliserContext context;
  context.settings = &settings;
  context.device_damping_n_s_per_m = scene.device.damping_n_s_per_m;
  context.period_s = scene.sampling.period_s();
  const double coupling_damping = context.value_or("coupling_damping_n_s_per_m", 0.0);
  if (coupling_damping > believed_damping(context) &&
      !context.value("coupling_stiffness_n_per_m")) {
    return SceneProblem{"algorithm.coupling_damping_n_s_per_m",
                        number_text(coupling_damping) +
                            " leaves no coupling stiffness: it takes at most b = " +
                            number_text(believed_damping(context)) +
                            " N·s/m unless coupling_stiffness_n_per_m is given"};
  }
  const double most_storage = EnergyBounding2010::hold_stiffness(context);
  const double storage = context.value_or("storage_stiffness_n_per_m", most_storage);
  if (storage > most_storage) {
    return SceneProblem{"algorithm.storage_stiffness_n_per_m",
                        number_text(storage) +
                            " is more than the hold can carry: it takes at most b/T = " +
                            number_text(most_storage) + " N/m"};
  }
  return std::nullopt;
}

Problem check_simulator(const SimulatorSettings& simulator) {
  const std::string key = "simulator.substeps";
  if (simulator.substeps < 1 || simulator.substeps > kMaximumSubsteps) {
    return SceneProblem{key, std::to_string(simulator.substeps) +
                                 " is out of range; it takes 1 to " +
                                 std::to_string(kMaximumSubsteps)};
  }
  if (simulator.integrator == Integrator::kExact && simulator.substeps != 1) {
    return SceneProblem{key, "the exact integrator has no substeps: it takes 1"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Integrator> find_integrator(std::string_view name) {
  const auto found = std::find(kIntegratorNames.begin(), kIntegratorNames.end(), name);
  if (found == kIntegratorNames.end()) return std::nullopt;
  return static_cast<Integrator>(std::distance(kIntegratorNames.begin(), found));
}

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  std::string text(buffer.data(), end);
  // 1e-06 and 1e+09 as people write them.
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos) {
    std::size_t digits = exponent + 2;
    if (text[digits] == '0') text.erase(digits, 1);
    if (text[exponent + 1] == '+') text.erase(exponent + 1, 1);
  }
  return text;
}

bool same_plant(const Scene& a, const Scene& b) {
  return a.device == b.device && a.hand == b.hand && a.simulator == b.simulator;
}

Scene second_axis(const Scene& scene) {
  Scene axis = scene;
  axis.device = scene.y->device;
  axis.hand = scene.y->hand;
  axis.walls = scene.y->walls;
  axis.y.reset();
  return axis;
}

std::uint64_t Scene::tick_count() const {
  return static_cast<std::uint64_t>(std::max(1.0, std::round(duration_s * sampling.rate_hz)));
}

Problem validate(const Scene& scene) {
  if (auto problem = check_table<Scene>("", scene, scene_number_keys())) return problem;
  if (auto problem =
          check_table<SamplingSettings>("sampling.", scene.sampling, sampling_number_keys())) {
    return problem;
  }
  if (scene.duration_s * scene.sampling.rate_hz > kMaximumTicks) {
    return SceneProblem{"duration_s", "gives more than " + number_text(kMaximumTicks) + " ticks"};
  }
  if (auto problem = check_device("device.", scene.device)) return problem;
  if (scene.hand) {
    if (auto problem = check_hand("hand.", *scene.hand)) return problem;
  }
  if (auto problem = check_second_axis(scene)) return problem;
  if (auto problem = check_walls(scene)) return problem;
  if (auto problem = check_algorithm(scene)) return problem;
  if (scene.y) {
    if (auto problem = check_algorithm(second_axis(scene))) return problem;
  }
  return check_simulator(scene.simulator);
}

}  // namespace hapticwall
