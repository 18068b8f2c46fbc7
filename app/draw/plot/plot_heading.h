// The line above a plot: title, unit, legend, and the choice of its signals.
#pragma once

#include <string>

#include "app/draw/plot/plot.h"

namespace hapticwall::draw {

// True if the line is chosen for this plot and not hidden.
[[nodiscard]] bool is_chosen(const PlotSurface& surface, const PlotDescription& plot,
                             const PlotLine& line);
[[nodiscard]] bool is_drawn(const PlotSurface& surface, const PlotDescription& plot,
                            const PlotLine& line);

// Draws the heading over `width` pixels and leaves the cursor below it. `note` stands beside the
// title in the tone of the hand; may be empty.
void draw_plot_heading(PlotSurface& surface, const PlotDescription& plot, const std::string& mark,
                       const std::string& note, float width);

}  // namespace hapticwall::draw
