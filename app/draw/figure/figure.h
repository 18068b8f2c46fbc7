// The figure of a run, drawn without a display and OpenGL: position, force, stiffness, passivity.
#pragma once

#include <cstdint>
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

// Shapes are for vector files.
enum class Ink : std::uint8_t { kPixels, kShapes };

struct FigureSize {
  int width = 1600;
  int height = 1200;
  Ink ink = Ink::kPixels;

  [[nodiscard]] constexpr FigureSize in(Ink other) const { return {width, height, other}; }
};

// Draws a figure with these signals of algorithms. Fails (ErrorKind::kFile) without memory for the
// pixels.
[[nodiscard]] Result<file::Picture> draw_figure(const Scene& scene, std::span<const Sample> samples,
                                                FigureSize size = {},
                                                const SignalNames& signals = {});

// The values of the scene in one line, for the readers of a figure.
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
  PhaseSettings phase;  // a shown plane stands beside the plots
};

[[nodiscard]] Result<file::Picture> draw_figure(const Scene& scene, const SampleHistory& history,
                                                const FigureView& view, FigureSize size = {});

}  // namespace hapticwall::draw
