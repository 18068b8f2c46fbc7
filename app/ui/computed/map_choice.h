// The map that the user has chosen: two numbers of the scene with their ranges, and algorithms.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/scene.h"
#include "core/scene_keys.h"
#include "core/study/stability_map.h"

namespace hapticwall::ui {

inline constexpr std::size_t kLiveMapValues = 60;  // max on an axis

struct MapAxisChoice {
  std::string path;  // key of a number of the scene; an unknown one gives a default
  std::optional<MapAxis> range = std::nullopt;  // nullopt: around the present value
  bool typed = false;  // the user has typed the range: it stays when the value leaves it
};

struct MapChoice {
  std::array<MapAxisChoice, 2> axes{
      {{"wall.stiffness_n_per_m"}, {"device.damping_n_s_per_m"}}};  // x, y
  std::vector<std::size_t> algorithms;  // indices in algorithms(), rising; empty: the one in force
};

// The numbers that a map can vary: all but the duration, which a session does not have.
[[nodiscard]] std::vector<SceneNumber> map_numbers(const Scene& scene);

// A decade on either side of a positive value, on a logarithmic axis. Else a linear axis: around
// the value where the number may be negative, eleven counts of a whole number, or from 0.
[[nodiscard]] MapAxis axis_around(const SceneNumber& number, std::optional<double> value);

// Sets an end of the range or its scale. Returns the problem, which changes nothing.
[[nodiscard]] std::optional<std::string> set_range(MapAxisChoice& choice, double low, double high,
                                                   bool logarithmic);

// Chooses another number.
void choose_number(MapAxisChoice& choice, const std::string& path);
void choose_algorithm_in_map(MapChoice& choice, std::size_t index, bool chosen);

// The map of the scene. A range that was not typed moves when its value has left it.
[[nodiscard]] StabilityMap map_of(MapChoice& choice, const Scene& scene);

// True if both maps have the same cells of the same scenes, whichever values the scenes have for
// the numbers of the axes.
[[nodiscard]] bool same_cells(const StabilityMap& a, const StabilityMap& b);

}  // namespace hapticwall::ui
