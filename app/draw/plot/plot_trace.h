// One line of a plot, drawn from its decimated trace.
#pragma once

#include <imgui.h>
#include <implot.h>

#include <vector>

#include "app/draw/plot/plot_envelope.h"
#include "app/draw/plot/sample_history.h"

namespace hapticwall::draw {

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

}  // namespace hapticwall::draw
