// The four plots of a session, one at a time: the live window and the printed figure draw the same.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <span>
#include <string>

#include "app/ui/sample_history.h"
#include "app/ui/theme.h"
#include "core/scene.h"

namespace hapticwall::ui {

enum class PlotId : std::uint8_t { kPosition, kForce, kStiffness, kPassivity };

struct PlotLine {
  Quantity quantity = Quantity::kPosition;
  const char* name = "";
  const char* meaning = "";
  Tone tone = Tone::kText;
};

struct PlotDescription {
  PlotId id = PlotId::kPosition;
  const char* title = "";
  const char* unit = "";
  double scale = 1.0;          // of SI values into `unit`
  double smallest_span = 1.0;  // of the value axis, in `unit`
  std::span<const PlotLine> lines;
};

[[nodiscard]] const PlotDescription& plot_description(PlotId id);

// One bit for each Quantity.
using HiddenLines = std::uint32_t;
[[nodiscard]] constexpr HiddenLines line_bit(Quantity quantity) {
  return HiddenLines{1} << static_cast<unsigned>(quantity);
}

inline constexpr float kLineWeight = 1.6F;  // pixels at scale 1

// What all plots of a frame share. Owned by the caller; all pointers must be valid.
struct PlotSurface {
  const Theme* theme = nullptr;
  const SampleHistory* history = nullptr;
  std::span<const WallSettings> walls;
  double* time_from_s = nullptr;  // linked time axes: read, and written when the user drags one
  double* time_to_s = nullptr;
  HiddenLines* hidden = nullptr;
  Trace* scratch = nullptr;
  bool fit_values = true;  // false: the value axes stay where the user put them
  bool interactive = true;
  float line_weight = kLineWeight;
  bool time_labels = true;  // below the plot
};

// Where the plot area (between the axes) was drawn, for whoever wants to look at its pixels.
struct PlotArea {
  ImVec2 position;
  ImVec2 size;
};

// Draws a heading with the legend and the plot below it into `size`. `mark` stands before the
// title: the paper's "(a)".
PlotArea draw_plot(const PlotSurface& surface, const PlotDescription& plot, const std::string& mark,
                   ImVec2 size);

// The range of the value axis: the extremes enlarged a little and rounded outwards to a round step.
[[nodiscard]] Extremes round_range(Extremes data, double smallest_span);

}  // namespace hapticwall::ui
