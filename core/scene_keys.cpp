#include "core/scene_keys.h"

#include <array>
#include <charconv>
#include <utility>

#include "core/algorithm/algorithm.h"
#include "core/environment/environment.h"
#include "core/estimator/estimator.h"

namespace hapticwall {
namespace {

constexpr ValueRange kMass{1e-6, 1e3};
constexpr ValueRange kStiffness{0.0, 1e9};
constexpr ValueRange kDamping{0.0, 1e4};
constexpr ValueRange kFriction{0.0, 1e3};
constexpr ValueRange kEncoder{0.0, 0.01};
constexpr ValueRange kForceLimit{0.0, 1e6};
constexpr ValueRange kForceRate{0.0, 1e9};
constexpr ValueRange kForceResolution{0.0, 1e3};
constexpr ValueRange kDelay{0.0, kMaxDelayTicks};
constexpr ValueRange kTimeConstant{0.0, 10.0};
constexpr ValueRange kRate{10.0, 100e3};
constexpr ValueRange kRenderEvery{1.0, kMaxRenderEvery};
constexpr ValueRange kLostTicks{0.0, 0.99};
constexpr ValueRange kJitter{0.0, 0.99};
// Less than any number that NumberKey::set() has clamped.
constexpr ValueRange kSeed{0.0, 2e9};
constexpr ValueRange kForceNoise{0.0, 1e3};
constexpr ValueRange kDuration{0.0, 1e6, true};
constexpr ValueRange kSpeedRange{0.0, 1e3, true};

template <typename Owner>
constexpr std::array<NumberKey<Owner>, 0> kKeys{};

template <>
constexpr auto kKeys<Scene> = std::to_array<NumberKey<Scene>>({{"duration_s", "s", kDuration, false,
                                                                &Scene::duration_s}});

template <>
constexpr auto kKeys<SamplingSettings> = std::to_array<NumberKey<SamplingSettings>>(
    {{"rate_hz", "Hz", kRate, false, &SamplingSettings::rate_hz},
     {"render_every", "ticks", kRenderEvery, false, &SamplingSettings::render_every},
     {"lost_ticks", "", kLostTicks, false, &SamplingSettings::lost_ticks},
     {"jitter", "", kJitter, false, &SamplingSettings::jitter},
     {"seed", "", kSeed, false, &SamplingSettings::seed}});

template <>
constexpr auto kKeys<DeviceSettings> = std::to_array<NumberKey<DeviceSettings>>(
    {{"mass_kg", "kg", kMass, true, &DeviceSettings::mass_kg},
     {"damping_n_s_per_m", "N·s/m", kDamping, true, &DeviceSettings::damping_n_s_per_m},
     {"friction_n", "N", kFriction, false, &DeviceSettings::friction_n},
     {"static_friction_n", "N", kFriction, false, &DeviceSettings::static_friction_n},
     {"stribeck_speed_m_per_s", "m/s", kSpeedRange, false, &DeviceSettings::stribeck_speed_m_per_s},
     {"encoder_m", "m", kEncoder, false, &DeviceSettings::encoder_m},
     {"position_noise_m", "m", kEncoder, false, &DeviceSettings::position_noise_m},
     {"force_limit_n", "N", kForceLimit, false, &DeviceSettings::force_limit_n},
     {"max_force_rate_n_per_s", "N/s", kForceRate, false, &DeviceSettings::max_force_rate_n_per_s},
     {"force_noise_n", "N", kForceNoise, false, &DeviceSettings::force_noise_n},
     {"force_resolution_n", "N", kForceResolution, false, &DeviceSettings::force_resolution_n},
     {"delay_ticks", "ticks", kDelay, false, &DeviceSettings::delay_ticks},
     {"amplifier_time_constant_s", "s", kTimeConstant, false,
      &DeviceSettings::amplifier_time_constant_s},
     {"start_m", "m", kPositionRange, false, &DeviceSettings::start_m},
     {"chai3d_stiffness_n_per_m", "N/m", kChaiStiffness, false,
      &DeviceSettings::chai3d_stiffness_n_per_m},
     {"chai3d_damping_n_s_per_m", "N·s/m", kChaiDamping, false,
      &DeviceSettings::chai3d_damping_n_s_per_m}});

template <>
constexpr auto kKeys<HandSettings> = std::to_array<NumberKey<HandSettings>>(
    {{"mass_kg", "kg", kMass, false, &HandSettings::mass_kg},
     {"stiffness_n_per_m", "N/m", kStiffness, false, &HandSettings::stiffness_n_per_m},
     {"damping_n_s_per_m", "N·s/m", kDamping, false, &HandSettings::damping_n_s_per_m},
     {"grip_stiffness_n_per_m", "N/m", kStiffness, false, &HandSettings::grip_stiffness_n_per_m},
     {"grip_damping_n_s_per_m", "N·s/m", kDamping, false, &HandSettings::grip_damping_n_s_per_m}});

template <>
constexpr auto kKeys<WallSettings> = std::to_array<NumberKey<WallSettings>>(
    {{"position_m", "m", kPositionRange, true, &WallSettings::position_m},
     {"stiffness_n_per_m", "N/m", kStiffness, true, &WallSettings::stiffness_n_per_m},
     {"damping_n_s_per_m", "N·s/m", kDamping, false, &WallSettings::damping_n_s_per_m}});

// 0 if the path rests.
double path_speed(const Scene& scene) {
  double speed = 0.0;
  if (!scene.x().hand) return speed;
  const std::vector<PathPoint>& path = scene.x().hand->path.points();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double duration_s = path[i].time_s - path[i - 1].time_s;
    if (duration_s <= 0.0) continue;
    speed = std::max(speed, std::abs(path[i].position_m - path[i - 1].position_m) / duration_s);
  }
  return speed;
}

void set_path_speed(Scene& scene, double speed) {
  const double factor = path_speed(scene) / speed;
  for (PathPoint& point : scene.x().hand->path.edit()) point.time_s *= factor;
}

// From this parameter on.
std::vector<ParameterNumberKey> number_keys_from(std::size_t first,
                                                 std::span<const ParameterDescription> parameters) {
  std::vector<ParameterNumberKey> keys;
  for (std::size_t i = first; i < parameters.size(); ++i) {
    const ParameterDescription& parameter = parameters[i];
    if (parameter.kind != ParameterKind::kNumber) continue;
    keys.push_back({i, parameter.key, parameter.unit, {parameter.minimum, parameter.maximum}});
  }
  return keys;
}

// The number keys of a table to which plug-ins append, before other threads start.
class GrowingKeys {
 public:
  explicit GrowingKeys(std::span<const ParameterDescription> parameters)
      : keys_(number_keys_from(0, parameters)), known_(parameters.size()) {}

  std::span<const ParameterNumberKey> of(std::span<const ParameterDescription> parameters) {
    if (parameters.size() == known_) return keys_;
    for (const ParameterNumberKey& key : number_keys_from(known_, parameters)) keys_.push_back(key);
    known_ = parameters.size();
    return keys_;
  }

 private:
  std::vector<ParameterNumberKey> keys_;
  std::size_t known_;
};

}  // namespace

template <typename Owner>
std::span<const NumberKey<Owner>> number_keys() {
  return kKeys<Owner>;
}
template std::span<const NumberKey<Scene>> number_keys();
template std::span<const NumberKey<SamplingSettings>> number_keys();
template std::span<const NumberKey<DeviceSettings>> number_keys();
template std::span<const NumberKey<HandSettings>> number_keys();
template std::span<const NumberKey<WallSettings>> number_keys();

std::span<const ParameterNumberKey> environment_number_keys() {
  static GrowingKeys keys(environment_parameters());
  return keys.of(environment_parameters());
}

std::span<const ParameterNumberKey> algorithm_number_keys() {
  static GrowingKeys keys(algorithm_parameters());
  return keys.of(algorithm_parameters());
}

std::span<const ParameterNumberKey> estimator_number_keys() {
  static const std::vector<ParameterNumberKey> kNumbers =
      number_keys_from(0, estimator_parameters());
  return kNumbers;
}

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  std::string text(buffer.data(), end);
  // to_chars() gives 1e-06 and 1e+09; people write 1e-6 and 1e9.
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos) {
    std::size_t digits = exponent + 2;
    if (text[digits] == '0') text.erase(digits, 1);
    if (text[exponent + 1] == '+') text.erase(exponent + 1, 1);
  }
  return text;
}

std::string out_of_range_text(double value, const ValueRange& range, std::string_view unit) {
  std::string text = number_text(value) + " is out of range; it takes ";
  text += range.minimum_excluded ? "more than " + number_text(range.minimum) + ", at most "
                                 : number_text(range.minimum) + " to ";
  text += number_text(range.maximum);
  if (!unit.empty()) text.append(" ").append(unit);
  return text;
}

std::string axis_key(std::string_view table, std::size_t axis) {
  return std::string(table) + (axis == 0 ? "" : ".y");
}

std::string wall_key(std::size_t index, std::size_t count) {
  return count == 1 ? "wall" : "wall[" + std::to_string(index) + "]";
}

std::optional<double> SceneNumber::get(const Scene& scene) const {
  if (path == kPathSpeed) return path_speed(scene);
  std::optional<double> value;
  visit_scene_numbers(
      scene,
      [&](const NumberPath& visited, const auto& key, const auto& owner) {
        if (visited == path) value = key.get(owner);
      },
      1);
  return value;
}

void SceneNumber::set(Scene& scene, double value) const {
  if (path == kPathSpeed) return set_path_speed(scene, value);
  visit_scene_numbers(
      scene,
      [&](const NumberPath& visited, const auto& key, auto& owner) {
        if (visited == path) key.set(owner, value);
      },
      1);
}

std::vector<SceneNumber> scene_numbers(const Scene& scene) {
  std::vector<SceneNumber> numbers;
  visit_scene_numbers(
      scene,
      [&](const NumberPath& path, const auto& key, const auto&) {
        if (key.key.starts_with("chai3d_")) return;  // no run changes with it
        numbers.push_back({path.text(), std::string(key.unit), key.range, key.whole()});
      },
      1);
  if (path_speed(scene) == 0.0) return numbers;
  const auto is_of_hand = [](const SceneNumber& number) {
    return number.path.starts_with("hand.");
  };
  const auto after_hand = std::find_if(numbers.rbegin(), numbers.rend(), is_of_hand).base();
  numbers.insert(after_hand, {std::string(kPathSpeed), "m/s", kSpeedRange});
  return numbers;
}

std::optional<SceneNumber> find_scene_number(const Scene& scene, std::string_view path) {
  constexpr std::string_view kFirstWall = "wall[0].";
  std::string wanted(path);
  if (scene.x().walls.size() == 1 && wanted.starts_with(kFirstWall)) {
    wanted.replace(0, kFirstWall.size(), "wall.");
  }
  for (const SceneNumber& number : scene_numbers(scene)) {
    if (number.path == wanted) return number;
  }
  return std::nullopt;
}

}  // namespace hapticwall
