// The fields of a stability map, one an algorithm: cells in their colours, the bounds of theory
// over them, axes with units. The figure and the window draw them.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "app/draw/plot/theme.h"
#include "core/study/bound_lines.h"
#include "core/study/stability_map.h"

namespace hapticwall::draw {

// The colours of a cell: calm where it settles, hotter the further it swings.
// The amplitudes between which the hot colours run, peak to peak; the lower one is the verdict's.
inline constexpr double kHottestM = 0.1;

[[nodiscard]] ImU32 settled_colour();
[[nodiscard]] ImU32 untouched_colour();
[[nodiscard]] ImU32 active_colour();
[[nodiscard]] ImU32 buzzing_colour();
[[nodiscard]] ImU32 oscillating_colour(double tail_peak_to_peak_m);
[[nodiscard]] ImU32 diverged_colour();
[[nodiscard]] ImU32 colour_of(const MapMetrics& figures);

// A bound of theory, or of CHAI3D, that crosses the map. `bound`: its number in the legend.
struct BoundLines {
  std::size_t bound = 0;
  std::vector<BoundSegment> lines;
};
// Bounds of theory first. The same for every algorithm: they are bounds of the bare wall.
[[nodiscard]] std::vector<BoundLines> map_bounds(const StabilityMap& map);

struct MapContents {
  const StabilityMap& map;
  std::span<const MapMetrics> figures;  // metrics of all cells
  std::span<const BoundLines> bounds;
  float scale;  // scale of the lines
};

// The cells of a field, in pixels: of equal size, the last y at the top. Size 0: no room.
struct MapFieldArea {
  ImVec2 corner;
  ImVec2 size;
};
// Called after a field; may draw and put items over it.
using OverMapField = std::function<void(std::size_t algorithm, const MapFieldArea& area)>;

// Fills the rest of the region.
void draw_map_fields(const Theme& theme, const MapContents& contents,
                     const OverMapField& over = {});

// The colours and the bounds, in as many lines as they need.
void draw_map_legend(std::span<const BoundLines> bounds, float scale);

}  // namespace hapticwall::draw
