// The four plots of a session. The live window and the printed figure draw them with the same code.
#pragma once

#include <imgui.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/draw/plot/extra_traces.h"
#include "app/draw/plot/plot_axes.h"
#include "app/draw/plot/plot_bounds.h"
#include "app/draw/plot/plot_cursors.h"
#include "app/draw/plot/plot_lines.h"
#include "app/draw/plot/plot_marks.h"
#include "app/draw/plot/plot_trace.h"
#include "app/draw/plot/plot_trigger.h"
#include "app/draw/plot/sample_history.h"
#include "app/draw/plot/theme.h"
#include "core/scene.h"

namespace hapticwall::draw {

inline constexpr float kLineWeight = 1.6F;  // pixels at scale 1

// The rectangle of the plot area (between the axes), for tests of its pixels.
struct PlotArea {
  ImVec2 position;
  ImVec2 size;

  [[nodiscard]] bool contains(ImVec2 place) const {
    return place.x >= position.x && place.x < position.x + size.x && place.y >= position.y &&
           place.y < position.y + size.y;
  }
};

// ImPlot's axis of values on this side.
[[nodiscard]] constexpr ImAxis value_axis(Side side) {
  return ImAxis_Y1 + static_cast<ImAxis>(side);
}

// The state of a plot between frames.
struct PlotAxes {
  ValueAxis left;
  ValueAxis right;
  ValueAxis far_right;
  bool large = false;  // the left axis has the large unit of its plot
  double knee = 0.0;   // of a left axis that is a symlog one (ticks.h), in its unit
  PlotArea area;

  [[nodiscard]] ValueAxis& on(Side side) {
    return side == Side::kLeft ? left : side == Side::kRight ? right : far_right;
  }
};
using AllPlotAxes = std::array<PlotAxes, kPlotCount>;  // indexed by PlotId

// Shared by all plots of a frame. Owned by the caller; a pointer may be null only if its comment
// says so.
struct PlotSurface {
  const Theme* theme = nullptr;
  const SampleHistory* history = nullptr;
  std::span<const WallSettings> walls;
  TimeWindow* window = nullptr;  // linked time axes: read, and written when the user drags one
  ChosenLines* chosen = nullptr;
  HiddenLines* hidden = nullptr;
  AllPlotAxes* axes = nullptr;
  PlotScratch* scratch = nullptr;
  Cursors* cursors = nullptr;                // null: none
  std::optional<double> contact_s;           // the contact that the trigger shows
  std::vector<BoundLine> bounds;             // bounds in the stiffness plot
  std::size_t axis = 0;                      // 1: y, in the title of a printed axis
  DeviceSettings device;                     // supplies encoder count and force limit
  std::span<const ExtraTrace> extra_traces;  // traces of other runs
  PlotMarks marks;                           // marks of recordings
  bool* show_bounds = nullptr;               // null: no choice; always shown
  bool simulated = true;                     // false: the plant's truth is unknown
  // Position as the encoder counts it, beside the true one of a simulator; null: no choice, shown.
  bool* show_counts = nullptr;
  bool interactive = true;
  bool time_labels = true;   // shown below the plot
  bool value_labels = true;  // shown beside the plot
  bool heading = true;       // shown above the plot
  bool line_names = true;    // shown at the ends of the lines
  float line_weight = kLineWeight;
  float column = 1.0F;      // pixels of a column of a band
  float title_room = 0.0F;  // pixels at the left of a printed plot for its axis title; 0: no title
  bool wants_newest = false;        // set when the user asks for the automatic time axis
  std::optional<double> pointed_s;  // set to the time under the pointer
};

// Draws a heading with the legend and the plot below it into `size`. `mark` precedes the title: the
// paper's "(a)". In print the axes have titles and chosen ticks, and the heading has no title.
// Wheel and drag change the time axis in the plot and the value axis over that axis; a right drag
// zooms into a rectangle; a double click makes both automatic again.
PlotArea draw_plot(PlotSurface& surface, const PlotDescription& plot, const std::string& mark,
                   ImVec2 size);

// The values that the automatic left axis shows, in SI units.
[[nodiscard]] Extremes shown_values(const PlotSurface& surface, const PlotDescription& plot);

// The plot in the units that its axes show, with the smallest span of the device's encoder.
[[nodiscard]] PlotDescription in_shown_units(const PlotSurface& surface,
                                             const PlotDescription& plot);

// "force F (N)", of a plot in shown units.
[[nodiscard]] std::string axis_title(const PlotSurface& surface, const PlotDescription& plot);

// Fits the left axis to values in SI units, and chooses its unit, unless the user has set the axis.
void fit_left_axis(const PlotSurface& surface, const PlotDescription& plot, Extremes values);

// The heading's note if the hand goes above `axis_maximum` within the window, and how far.
[[nodiscard]] std::string hand_outside(const PlotSurface& surface, const PlotDescription& plot,
                                       double axis_maximum);

}  // namespace hapticwall::draw
