// A number of a scene by its dotted path, the one that --set takes: what maps and studies vary.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene.h"
#include "core/scene_keys.h"

namespace hapticwall {

struct SceneNumber {
  std::string path;  // "wall.stiffness_n_per_m"
  std::string unit;  // "" for a pure number
  ValueRange range;
  bool whole = false;  // takes whole numbers only
  // Nothing where the scene leaves the part out.
  std::function<std::optional<double>(const Scene&)> get;
  // Of a scene with the same tables as the one that it was found in. A part that the scene leaves
  // out is added; validate() judges the outcome.
  std::function<void(Scene&, double)> set;
};

// The speed of the path's fastest part; setting it scales all times of the path. No key of a scene
// file: there the path itself is the key.
inline constexpr std::string_view kPathSpeed = "hand.path_speed_m_per_s";

// Every number of axis x, of the loop and of the algorithms, in the order of a scene file; what one
// algorithm alone reads is a number of every scene. kPathSpeed where the hand's path moves.
// Realtime-safe: no.
[[nodiscard]] std::vector<SceneNumber> scene_numbers(const Scene& scene);

// "wall[0].KEY" is the only wall's too. Realtime-safe: no.
[[nodiscard]] std::optional<SceneNumber> find_scene_number(const Scene& scene,
                                                           std::string_view path);

}  // namespace hapticwall
