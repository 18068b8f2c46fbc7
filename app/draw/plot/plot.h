// The four plots of a session, one at a time: the live window and the printed figure draw the same.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/extra_traces.h"
#include "app/ui/plot_bounds.h"
#include "app/ui/plot_cursors.h"
#include "app/ui/plot_envelope.h"
#include "app/ui/plot_lines.h"
#include "app/ui/plot_marks.h"
#include "app/ui/plot_trigger.h"
#include "app/ui/sample_history.h"
#include "app/ui/theme.h"
#include "core/scene.h"

namespace hapticwall::ui {

inline constexpr float kLineWeight = 1.6F;  // pixels at scale 1

// Where the plot area (between the axes) was drawn, for whoever wants to look at its pixels.
struct PlotArea {
  ImVec2 position;
  ImVec2 size;

  [[nodiscard]] bool contains(ImVec2 place) const {
    return place.x >= position.x && place.x < position.x + size.x && place.y >= position.y &&
           place.y < position.y + size.y;
  }
};

// An axis of values: fitted to what is seen, or where the user has put it.
struct ValueAxis {
  bool manual = false;
  double minimum = 0.0;
  double maximum = 1.0;
};

// What a plot remembers from frame to frame.
struct PlotAxes {
  ValueAxis left;
  ValueAxis right;
  PlotArea area;
};
using AllPlotAxes = std::array<PlotAxes, kPlotCount>;  // by PlotId

// What all plots of a frame share. Owned by the caller; pointers must be valid, or null where that
// is told.
struct PlotSurface {
  const Theme* theme = nullptr;
  const SampleHistory* history = nullptr;
  std::span<const WallSettings> walls;
  TimeWindow* window = nullptr;  // linked time axes: read, and written when the user drags one
  ChosenLines* chosen = nullptr;
  HiddenLines* hidden = nullptr;
  AllPlotAxes* axes = nullptr;
  Trace* scratch = nullptr;
  std::vector<PixelColumn>* columns = nullptr;  // scratch, too
  Cursors* cursors = nullptr;                   // null: none
  std::optional<double> contact_s;              // the contact that the window stands at
  std::vector<BoundLine> bounds;                // of the stiffness plot
  std::span<const ExtraTrace> extra_traces;     // of other runs
  PlotMarks marks;                              // of recordings
  bool* show_bounds = nullptr;                  // null: no choice; shown where there are any
  bool simulated = true;                        // false: nobody knows what only a simulator does
  bool interactive = true;
  bool time_labels = true;   // below the plot
  bool value_labels = true;  // beside it
  bool heading = true;       // above it
  float line_weight = kLineWeight;
  // Called after items that somebody may want to find again; may be empty.
  std::function<void(std::string_view)> remember;
  bool wants_newest = false;  // set where the user asks for the automatic time axis
};

// Draws a heading with the legend and the plot below it into `size`. `mark` stands before the
// title: the paper's "(a)". A wheel or a drag in the plot moves time, over the value axis values; a
// right drag zooms into a rectangle; a double click makes both automatic again.
PlotArea draw_plot(PlotSurface& surface, const PlotDescription& plot, const std::string& mark,
                   ImVec2 size);

// What the automatic left axis would show of the window.
[[nodiscard]] Extremes automatic_values(const PlotSurface& surface, const PlotDescription& plot);

// Where the hand is above `axis_maximum` within the window: how far, for the heading.
[[nodiscard]] std::string hand_outside(const PlotSurface& surface, const PlotDescription& plot,
                                       double axis_maximum);

// The range of the value axis: the extremes enlarged a little and rounded outwards to a round step.
[[nodiscard]] Extremes round_range(Extremes data, double smallest_span);

// Labels of a time axis whose visible length is a double at `length_s`: as many digits as it takes.
int format_time(double value, char* text, int size, void* length_s);

}  // namespace hapticwall::ui
