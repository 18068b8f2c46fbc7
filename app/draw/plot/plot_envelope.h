// Lines of a plot, drawn from decimated traces. A line that oscillates many times within a pixel is
// drawn as the band that it fills, column by column, instead of stroke over stroke. It looks the
// same at a fraction of the cost.
#pragma once

#include <imgui.h>
#include <implot.h>

#include <vector>

#include "app/draw/plot/sample_history.h"

namespace hapticwall::draw {

// From the units of an axis to pixels; ImPlot's linear axes.
struct PixelScale {
  double origin = 0.0;  // pixels at 0
  double scale = 1.0;   // pixels a unit

  [[nodiscard]] double operator()(double value) const { return origin + scale * value; }
};

// A column of pixels and its painted part; y grows downwards.
struct PixelColumn {
  int x = 0;
  double top = 0.0;
  double bottom = 0.0;
};

// True if the line moves so far up and down that a band draws it better.
[[nodiscard]] bool is_band(const Trace& trace, const PixelScale& x, const PixelScale& y);

// For each column of pixels with a point of the trace: its points and the line from the column
// before. Overwrites `columns`.
void band_of(const Trace& trace, const PixelScale& x, const PixelScale& y,
             std::vector<PixelColumn>& columns);

struct TraceStyle {
  const char* name = "";  // unique in the plot
  ImVec4 colour;
  float weight = 1.0F;  // pixels
};

// Draws the trace into the current plot, as strokes or as the band that they fill. `columns`:
// scratch memory.
void draw_trace(const Trace& trace, const TraceStyle& style, ImAxis value_axis,
                std::vector<PixelColumn>& columns);

// The width of the current plot in columns of pixels.
[[nodiscard]] std::size_t plot_columns();

// Paints the band, at least `weight` pixels thick.
void draw_band(ImDrawList* list, const std::vector<PixelColumn>& columns, ImU32 colour,
               float weight);

}  // namespace hapticwall::draw
