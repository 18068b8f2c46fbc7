// The line above a plot: title, unit, legend, and the choice of its signals.
#pragma once

#include <span>
#include <string>

#include "app/draw/plot/plot.h"

namespace hapticwall::draw {

// True for the measured position while only the true one is shown.
[[nodiscard]] bool hides_counts(const PlotSurface& surface, const PlotLine& line);
// The line as it looks now: a true position that stands for the measured one has its look.
[[nodiscard]] PlotLine shown_line(const PlotSurface& surface, const PlotDescription& plot,
                                  const PlotLine& line);
// True if the line is chosen for this plot and not hidden.
[[nodiscard]] bool is_chosen(const PlotSurface& surface, const PlotDescription& plot,
                             const PlotLine& line);
[[nodiscard]] bool is_drawn(const PlotSurface& surface, const PlotDescription& plot,
                            const PlotLine& line);

// Draws the heading over `width` pixels and leaves the cursor below it. `hand`: the entry of the
// hand in the legend, if it is not its name.
void draw_plot_heading(PlotSurface& surface, const PlotDescription& plot, const std::string& mark,
                       const std::string& hand, float width);

// A plot in a legend of several ones; `hand` as above.
struct LegendOf {
  PlotDescription plot;
  std::string hand;
};
// The lines of these plots, in as many rows as they need. Leaves the cursor below.
void draw_plot_legends(PlotSurface& surface, std::span<const LegendOf> plots, float width);

}  // namespace hapticwall::draw
