// The numbers of a scene as data: key, unit, range and place of each. Scene files, --set,
// validation, sidecars, maps and the sliders of the window all read these tables.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall {

// Both ends belong to the range, unless the minimum is excluded.
struct ValueRange {
  double minimum = 0.0;
  double maximum = 0.0;
  bool minimum_excluded = false;

  [[nodiscard]] bool contains(double value) const {  // false for NaN
    return (minimum_excluded ? value > minimum : value >= minimum) && value <= maximum;
  }
};

// A number for people: the shortest form that reads back the same, such as 1e9 and 1e-6.
[[nodiscard]] std::string number_text(double value);
// "-1 is out of range; it takes 1e-6 to 1000 kg".
[[nodiscard]] std::string out_of_range_text(double value, const ValueRange& range,
                                            std::string_view unit);

// A number of the table Owner.
template <typename Owner>
struct NumberKey {
  std::string_view key;
  std::string_view unit;
  ValueRange range;
  bool required = false;  // in a scene file
  std::variant<double Owner::*, std::optional<double> Owner::*, std::optional<int> Owner::*> member;

  // Takes whole numbers only.
  [[nodiscard]] bool whole() const {
    return std::holds_alternative<std::optional<int> Owner::*>(member);
  }
  // nullopt if the scene omits the number.
  [[nodiscard]] std::optional<double> get(const Owner& owner) const {
    return std::visit([&](auto place) { return std::optional<double>(owner.*place); }, member);
  }
  // Rounds and clamps to int for a whole key. Does not validate.
  void set(Owner& owner, double value) const {
    if (whole()) {
      constexpr double kMax = std::numeric_limits<int>::max();
      owner.*std::get<std::optional<int> Owner::*>(member) =
          static_cast<int>(std::clamp(std::round(value), -kMax, kMax));
    } else if (const auto* plain = std::get_if<double Owner::*>(&member)) {
      owner.** plain = value;
    } else {
      owner.*std::get<std::optional<double> Owner::*>(member) = value;
    }
  }
};

// The numbers of one table, in the order of a scene file. Owner: Scene (outside of all tables),
// SamplingSettings, DeviceSettings, HandSettings or WallSettings.
template <typename Owner>
[[nodiscard]] std::span<const NumberKey<Owner>> number_keys();

// A number of [environment], [algorithm] or [estimator], with the members of NumberKey.
struct ParameterNumberKey {
  std::size_t index =
      0;  // in environment_parameters(), algorithm_parameters() or estimator_parameters()
  std::string_view key;
  std::string_view unit;
  ValueRange range;

  [[nodiscard]] bool whole() const { return false; }
  template <typename Settings>
  [[nodiscard]] std::optional<double> get(const Settings& owner) const {
    return owner.values[index];
  }
  template <typename Settings>
  void set(Settings& owner, double value) const {
    owner.values[index] = value;
  }
};
// Switches and choices are left out. A plug-in that is loaded later appends its keys, which ends
// the life of earlier spans.
[[nodiscard]] std::span<const ParameterNumberKey> environment_number_keys();
[[nodiscard]] std::span<const ParameterNumberKey> algorithm_number_keys();
[[nodiscard]] std::span<const ParameterNumberKey> estimator_number_keys();

// "device" of axis x, "device.y" of axis y.
[[nodiscard]] std::string axis_key(std::string_view table, std::size_t axis);
// "wall[2]"; "wall" if it is the only one.
[[nodiscard]] std::string wall_key(std::size_t index, std::size_t count);

// The dotted name that --set takes.
struct NumberPath {
  std::string_view table;  // ends with its point: "device."
  std::string_view key;

  [[nodiscard]] std::string text() const { return std::string(table).append(key); }
  friend bool operator==(const NumberPath& path, std::string_view text) {
    return text.starts_with(path.table) && text.substr(path.table.size()) == path.key;
  }
};

// Calls visit(path, key, owner) for every number of the first `axes` axes, of the loop and of all
// environments, algorithms and estimators, in the order of a scene file. `key` is a NumberKey or
// ParameterNumberKey of `owner`.
template <typename AnyScene, typename Visit>
void visit_scene_numbers(AnyScene& scene, const Visit& visit, std::size_t axes = kMaxAxes) {
  const auto visit_keys = [&](const std::string& table, const auto& keys, auto& owner) {
    for (const auto& key : keys) visit(NumberPath{table, key.key}, key, owner);
  };
  const auto visit_table = [&](const std::string& table, auto& owner) {
    visit_keys(table, number_keys<std::remove_cvref_t<decltype(owner)>>(), owner);
  };
  const std::span visited(scene.axes.data(), std::min(axes, scene.axes.size()));
  visit_table("", scene);
  visit_table("sampling.", scene.sampling);
  for (std::size_t i = 0; i < visited.size(); ++i) {
    visit_table(axis_key("device", i) + ".", visited[i].device);
  }
  for (std::size_t i = 0; i < visited.size(); ++i) {
    if (visited[i].hand) visit_table(axis_key("hand", i) + ".", *visited[i].hand);
  }
  std::size_t walls = 0;
  for (const auto& axis : visited) walls += axis.walls.size();
  std::size_t index = 0;
  for (auto& axis : visited) {
    for (auto& wall : axis.walls) visit_table(wall_key(index++, walls) + ".", wall);
  }
  visit_keys("environment.", environment_number_keys(), scene.environment);
  visit_keys("algorithm.", algorithm_number_keys(), scene.algorithm);
  visit_keys("estimator.", estimator_number_keys(), scene.estimator);
}

// A number of axis x, of the loop, an environment, an algorithm or an estimator by its path: what
// maps and studies vary.
struct SceneNumber {
  std::string path;  // "wall.stiffness_n_per_m"
  std::string unit;  // "" for a pure number
  ValueRange range;
  bool whole = false;  // takes whole numbers only

  // nullopt if the scene omits the part.
  [[nodiscard]] std::optional<double> get(const Scene& scene) const;
  // The scene must have the same tables as the one of find_scene_number(). Adds an omitted part.
  // Does not validate.
  void set(Scene& scene, double value) const;
};

// Speed of the fastest part of the path; setting it scales all times of the path. Not a key of a
// scene file.
inline constexpr std::string_view kPathSpeed = "hand.path_speed_m_per_s";

// All of them; kPathSpeed, after the other numbers of the hand, if the path moves.
// Realtime-safe: no.
[[nodiscard]] std::vector<SceneNumber> scene_numbers(const Scene& scene);

// "wall[0].KEY" also names the only wall. Realtime-safe: no.
[[nodiscard]] std::optional<SceneNumber> find_scene_number(const Scene& scene,
                                                           std::string_view path);

// Points within a scene file. A file named by `path_file` may have more.
inline constexpr std::size_t kMaxPathPoints = 10000;
// Ranges of a point of a path: seconds from the start, and metres. A run beyond ±1 m is `diverged`.
inline constexpr ValueRange kPathTimeRange{0.0, 1e6};
inline constexpr ValueRange kPositionRange{-1.0, 1.0};
// Ranges of the limits that CHAI3D sets for a device, N/m and N·s/m.
inline constexpr ValueRange kChaiStiffness{0.0, 1e9, true};
inline constexpr ValueRange kChaiDamping{0.0, 1e4, true};

}  // namespace hapticwall
