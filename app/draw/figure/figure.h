// The figure of a run, drawn without a display (EGL, no window): position, force, stiffness,
// passivity.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/draw/plot/phase_plot.h"
#include "app/draw/plot/plot.h"
#include "app/draw/plot/sample_history.h"
#include "app/file/picture.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::draw {

struct FigureSize {
  int width = 1600;
  int height = 1200;
};

// Fails (ErrorKind::kFile) with a sentence where no off-screen OpenGL 3.3 is to be had.
[[nodiscard]] Result<file::Picture> draw_figure(const Scene& scene, std::span<const Sample> samples,
                                                FigureSize size = {});

// The scene in one line: what a reader needs to know how the figure came about.
[[nodiscard]] std::string describe(const Scene& scene);

// What of a history a figure shows.
struct FigureView {
  TimeWindow window;
  std::span<const PlotId> plots;  // from top to bottom
  ChosenLines lines = usual_lines();
  HiddenLines hidden = 0;
  AllPlotAxes axes;               // where the user has put the axes of values
  std::vector<BoundLine> bounds;  // of the stiffness plot
  std::vector<ExtraTrace> extra_traces;
  PlotMarks marks;
  PhaseSettings phase;  // the plane stands beside the plots where it is shown
};

[[nodiscard]] Result<file::Picture> draw_figure(const Scene& scene, const SampleHistory& history,
                                                const FigureView& view, FigureSize size = {});

}  // namespace hapticwall::draw
