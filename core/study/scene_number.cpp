#include "core/study/scene_number.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {
namespace {

constexpr ValueRange kSpeedRange{0.0, 1e3, true};
constexpr std::string_view kOnlyWall = "wall.";
constexpr std::string_view kFirstWall = "wall[0].";

// The numbers of one table; `owner` finds it in a scene.
template <typename Owner>
void append(std::vector<SceneNumber>& numbers, const std::string& prefix,
            std::span<const NumberKey<Owner>> keys, const std::function<Owner&(Scene&)>& owner) {
  for (const NumberKey<Owner>& key : keys) {
    numbers.push_back(
        {prefix + std::string(key.key), std::string(key.unit), key.range, key.whole(),
         [&key, owner](const Scene& scene) {
           // The table is only read.
           return key.get(owner(const_cast<Scene&>(scene)));  // NOLINT
         },
         [&key, owner](Scene& scene, double value) { key.set(owner(scene), value); }});
  }
}

void append_algorithm(std::vector<SceneNumber>& numbers) {
  const std::span<const ParameterDescription> parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const ParameterDescription& parameter = parameters[i];
    if (parameter.kind != ParameterKind::kNumber) continue;
    numbers.push_back({"algorithm." + std::string(parameter.key), std::string(parameter.unit),
                       ValueRange{parameter.minimum, parameter.maximum}, false,
                       [i](const Scene& scene) { return scene.algorithm.values.at(i); },
                       [i](Scene& scene, double value) { scene.algorithm.values.at(i) = value; }});
  }
}

// 0 where the path rests.
double path_speed(const Scene& scene) {
  double speed = 0.0;
  if (!scene.hand) return speed;
  const std::vector<PathPoint>& path = scene.hand->path;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double duration_s = path[i].time_s - path[i - 1].time_s;
    if (duration_s <= 0.0) continue;
    speed = std::max(speed, std::abs(path[i].position_m - path[i - 1].position_m) / duration_s);
  }
  return speed;
}

void set_path_speed(Scene& scene, double speed) {
  const double factor = path_speed(scene) / speed;
  for (PathPoint& point : scene.hand->path) point.time_s *= factor;
}

void append_hand(std::vector<SceneNumber>& numbers, const Scene& scene) {
  if (!scene.hand) return;
  append<HandSettings>(numbers, "hand.", hand_number_keys(),
                       [](Scene& of) -> HandSettings& { return *of.hand; });
  if (path_speed(scene) == 0.0) return;
  numbers.push_back(
      {std::string(kPathSpeed), "m/s", kSpeedRange, false, path_speed, set_path_speed});
}

void append_walls(std::vector<SceneNumber>& numbers, const Scene& scene) {
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const std::string prefix =
        scene.walls.size() == 1 ? std::string(kOnlyWall) : "wall[" + std::to_string(i) + "].";
    append<WallSettings>(numbers, prefix, wall_number_keys(),
                         [i](Scene& of) -> WallSettings& { return of.walls.at(i); });
  }
}

}  // namespace

std::vector<SceneNumber> scene_numbers(const Scene& scene) {
  std::vector<SceneNumber> numbers;
  append<Scene>(numbers, "", scene_number_keys(), [](Scene& of) -> Scene& { return of; });
  append<SamplingSettings>(numbers, "sampling.", sampling_number_keys(),
                           [](Scene& of) -> SamplingSettings& { return of.sampling; });
  append<DeviceSettings>(numbers, "device.", device_number_keys(),
                         [](Scene& of) -> DeviceSettings& { return of.device; });
  append_hand(numbers, scene);
  append_walls(numbers, scene);
  append_algorithm(numbers);
  return numbers;
}

std::optional<SceneNumber> find_scene_number(const Scene& scene, std::string_view path) {
  std::string wanted(path);
  if (scene.walls.size() == 1 && wanted.starts_with(kFirstWall)) {
    wanted.replace(0, kFirstWall.size(), kOnlyWall);
  }
  std::vector<SceneNumber> numbers = scene_numbers(scene);
  const auto found = std::ranges::find(numbers, wanted, &SceneNumber::path);
  if (found == numbers.end()) return std::nullopt;
  return std::move(*found);
}

}  // namespace hapticwall
