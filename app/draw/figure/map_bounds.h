// The bounds of theory over a map, as they are drawn.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <span>
#include <vector>

#include "core/study/bound_lines.h"
#include "core/study/stability_map.h"

namespace hapticwall::draw {

inline constexpr float kMapLineWeight = 2.0F;  // pixels at scale 1

// A bound of theory, or what CHAI3D allows, as it is drawn.
struct BoundStyle {
  const char* name;
  BoundMember bound;  // nullptr: of CHAI3D
  ImU32 colour;
  float weight = kMapLineWeight;
};
[[nodiscard]] std::span<const BoundStyle> bound_styles();

// A bound that crosses the map. `bound`: its index in bound_styles().
struct BoundLines {
  std::size_t bound = 0;
  std::vector<BoundSegment> lines;
};
// Bounds of theory first. The same for every algorithm: they are bounds of the bare wall.
[[nodiscard]] std::vector<BoundLines> map_bounds(const StabilityMap& map);

}  // namespace hapticwall::draw
