// One line of a plot, from what decimation has left of it.
#pragma once

#include <imgui.h>
#include <implot.h>

#include <vector>

#include "app/ui/plot_envelope.h"
#include "app/ui/sample_history.h"

namespace hapticwall::ui {

struct TraceStyle {
  const char* name = "";  // that no other line of the plot has
  ImVec4 colour;
  float weight = 1.0F;  // pixels
};

// Draws the trace into the current plot, as strokes or as the band that they fill. `columns` is
// scratch.
void draw_trace(const Trace& trace, const TraceStyle& style, ImAxis value_axis,
                std::vector<PixelColumn>& columns);

// How many columns of pixels the current plot has.
[[nodiscard]] std::size_t plot_columns();

}  // namespace hapticwall::ui
