// Draws a signal into the current plot.
#pragma once

#include <imgui.h>
#include <implot.h>

#include <optional>
#include <vector>

#include "app/draw/axis/dashes.h"
#include "app/draw/plot/plot_labels.h"
#include "app/draw/plot/signal_shape.h"

namespace hapticwall::draw {

struct TraceSource {
  const SampleHistory& history;
  Quantity quantity;
  IndexRange range;  // not empty
  double scale = 1.0;
  double shift_s = 0.0;  // plot time of the history's time 0
  // Values beyond these are drawn at the edge; SI.
  std::optional<Extremes> clip = std::nullopt;
  double knee = 0.0;  // of a symlog axis (ticks.h); 0: the axis is linear
};

struct TraceStyle {
  const char* name = "";  // unique in the plot
  ImVec4 colour;
  float weight = 1.0F;  // pixels
  Dash dash = Dash::kSolid;
  // A band of this height, in the unit of the axis, is faint; one of several times the height is
  // bold.
  double faint_height = 1.0;
  float band_strength = 1.0F;   // 0: no band
  float column = 1.0F;          // pixels of a column of a band
  const char* label = nullptr;  // label at the line's end; null: none
};

// Memory for the traces of one plot. `ink` grows with each trace; everything else is scratch.
struct PlotScratch {
  SignalShape shape;
  std::vector<ImVec2> points;
  PlotInk ink;
};

// The share of the colour in a band of this height.
[[nodiscard]] float band_alpha(double height, double faint_height);

// Draws the signal's line and, where it oscillates, the band of its extremes.
void draw_trace(const TraceSource& source, const TraceStyle& style, ImAxis value_axis,
                PlotScratch& scratch);

}  // namespace hapticwall::draw
