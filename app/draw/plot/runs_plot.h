// One quantity of several runs over time, a line for each in the colour of its verdict.
#pragma once

#include <imgui.h>

#include <span>
#include <string>

#include "app/draw/plot/plot_lines.h"
#include "app/draw/plot/plot_trace.h"
#include "app/draw/plot/plot_trigger.h"
#include "app/draw/plot/sample_history.h"
#include "app/draw/plot/theme.h"
#include "core/scene.h"

namespace hapticwall::draw {

struct ShownRun {
  const SampleHistory& history;
  std::string name;
  Tone tone = Tone::kText;
  bool dashed = false;  // tells two lines of one tone apart
};

struct RunsPlot {
  const Theme& theme;
  const PlotDescription& plot;  // title, unit, and the shape of its axis
  Quantity quantity;
  std::span<const ShownRun> runs;
  std::span<const WallSettings> walls;  // shown as areas; empty in a plot that is not of positions
  TimeWindow window;
};

// Draws the heading with the names of the runs, and the plot below it, into `size` from the cursor
// on. Takes no input.
void draw_runs_plot(const RunsPlot& shown, PlotScratch& scratch, ImVec2 size);

}  // namespace hapticwall::draw
