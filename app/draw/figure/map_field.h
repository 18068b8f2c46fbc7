// The fields of a stability map, one an algorithm: cells in their colours, the bounds of theory
// over them, axes with units. The figure and the window draw them.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "app/draw/figure/map_bounds.h"
#include "app/draw/plot/theme.h"
#include "core/study/stability_map.h"

namespace hapticwall::draw {

[[nodiscard]] ImU32 colour_of(const MapMetrics& figures);

// "wall stiffness K (kN/m)".
[[nodiscard]] std::string map_axis_title(const MapAxis& axis);

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
// The place of a field within its figure.
struct MapFieldFrame {
  ImVec2 size;               // of everything: heading, labels, titles
  bool titles = true;        // of both axes
  bool value_labels = true;  // of the axis that goes up
  float labels = 0.0F;       // pixels from the left to the heading, beside which the labels stand
};
MapFieldArea draw_map_field(const Theme& theme, const MapContents& contents, std::size_t algorithm,
                            const MapFieldFrame& frame);

// Called after a field; may draw and put items over it.
using OverMapField = std::function<void(std::size_t algorithm, const MapFieldArea& area)>;

// Fills the rest of the region of a window.
void draw_map_fields(const Theme& theme, const MapContents& contents,
                     const OverMapField& over = {});

}  // namespace hapticwall::draw
