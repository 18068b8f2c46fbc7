// The figure of a run, drawn without a display and OpenGL: position, force, stiffness, passivity.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/draw/figure/paper.h"
#include "app/draw/plot/phase_plot.h"
#include "app/draw/plot/plot.h"
#include "app/draw/plot/sample_history.h"
#include "app/file/picture.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::draw {

// Draws a figure with these signals of algorithms. `axis`: 1 for axis y, which `scene` has in the
// place of x. Fails like draw_page().
[[nodiscard]] Result<file::Picture> draw_figure(const Scene& scene, std::span<const Sample> samples,
                                                const Paper& paper = {},
                                                const SignalNames& signals = {},
                                                std::size_t axis = 0);

// The values of the scene in one text without line ends, for the readers of a figure.
[[nodiscard]] std::string describe(const Scene& scene);

// The part of a history that a figure shows, and how.
struct FigureView {
  TimeWindow window;
  std::span<const PlotId> plots;  // plots from top to bottom
  ChosenLines lines = usual_lines();
  HiddenLines hidden = 0;
  AllPlotAxes axes;               // axes as the user has set them
  std::vector<BoundLine> bounds;  // bounds in the stiffness plot
  std::vector<ExtraTrace> extra_traces;
  PlotMarks marks;
  std::size_t axis = 0;
  PhaseSettings phase;  // a shown plane stands beside the plots
};

[[nodiscard]] Result<file::Picture> draw_figure(const Scene& scene, const SampleHistory& history,
                                                const FigureView& view, const Paper& paper = {});

}  // namespace hapticwall::draw
