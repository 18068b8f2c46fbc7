#include "app/draw/figure/figure.h"

#include <fmt/format.h>
#include <imgui.h>
#include <implot.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/draw/axis/axis_titles.h"
#include "app/draw/axis/symbol_text.h"
#include "app/draw/figure/page.h"
#include "app/draw/plot/phase_plot.h"
#include "app/draw/plot/plot.h"
#include "app/draw/plot/theme.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::draw {
namespace {

constexpr float kPrintLineWeight = 1.2F;  // pixels at scale 1: 0.8 pt
constexpr double kPlotMm = 30.0;          // height of a plot with its legend
constexpr double kTimeAxisMm = 6.0;       // more, of the last plot
constexpr float kPhaseShare = 0.38F;  // share of the width for the plot of force over penetration

void draw_title(const Theme& theme, const Scene& scene, std::size_t axis) {
  const bool known = scene.algorithm.index < algorithms().size();
  strong_text(theme,
              fmt::format("{}{}  ·  {}", scene.name, axis == 1 ? ", axis y" : "",
                          known ? algorithm_label(scene.algorithm) : "?"),
              kTitleFontSize);
  const FontScope font(nullptr, kSmallFontSize);
  wrapped_symbol_text(theme.packed(Tone::kMuted), describe(scene));
}

// The same for all plots, so that their areas begin at one place.
float room_of_titles(const PlotSurface& surface, std::span<const PlotId> plots,
                     const PlotTable& table, float height) {
  constexpr float kLegendShare = 0.75F;  // of the height, left by legend and labels
  float room = 0.0F;
  for (const PlotId id : plots) {
    const PlotDescription plot = in_shown_units(surface, table[id]);
    room = std::max(room, title_room(axis_title(surface, plot), kLegendShare * height));
  }
  return room;
}

void draw_plots(PlotSurface& surface, std::span<const PlotId> plots, float width) {
  const PlotTable table(surface.history->signals());
  const float height = pixels_of_mm(kPlotMm);
  surface.title_room = room_of_titles(surface, plots, table, height);
  ImPlot::BeginAlignedPlots("plots");  // gives all plots one left and one right margin
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const std::string mark = fmt::format("({}) ", static_cast<char>('a' + i));
    surface.time_labels = i + 1 == plots.size();
    const float more = surface.time_labels ? pixels_of_mm(kTimeAxisMm) : 0.0F;
    draw_plot(surface, table[plots[i]], mark, {width, height + more});
  }
  ImPlot::EndAlignedPlots();
}

// At the cursor; leaves it below.
void draw_plane(PlotSurface& surface, const FigureView& view, float side) {
  PhaseSettings settings = view.phase;
  PhaseView memory;
  draw_phase_plot(surface, settings, memory, ImVec2(side, side));
}

void draw_contents(const Scene& scene, PlotSurface& surface, const FigureView& view, bool narrow) {
  draw_title(*surface.theme, scene, view.axis);
  ImGui::Spacing();
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (!view.phase.shown) return draw_plots(surface, view.plots, width);
  if (narrow || view.plots.empty()) {
    draw_plots(surface, view.plots, width);
    return draw_plane(surface, view, narrow ? width : kPhaseShare * width);
  }
  const float side = kPhaseShare * width;
  ImGui::SetCursorScreenPos(ImVec2(corner.x + width - side, corner.y));
  draw_plane(surface, view, side);
  const float bottom = ImGui::GetCursorScreenPos().y;
  ImGui::SetCursorScreenPos(corner);
  draw_plots(surface, view.plots, width - side - 2.0F * ImGui::GetFontSize());
  ImGui::SetCursorScreenPos({corner.x, std::max(bottom, ImGui::GetCursorScreenPos().y)});
}

}  // namespace

std::string describe(const Scene& scene) {
  std::string text;
  for (const WallSettings& wall : scene.x().walls) {
    text += fmt::format("wall {:.4g} kN/m", wall.stiffness_n_per_m / 1e3);
    if (wall.damping_n_s_per_m != 0.0)
      text += fmt::format(" and {:.4g} N·s/m", wall.damping_n_s_per_m);
    text += fmt::format(" at {:.4g} mm  ·  ", wall.position_m * 1e3);
  }
  text += fmt::format("{:g} Hz  ·  handle {:.4g} g, {:.4g} N·s/m", scene.sampling.rate_hz,
                      scene.x().device.mass_kg * 1e3, scene.x().device.damping_n_s_per_m);
  if (scene.x().device.friction_n)
    text += fmt::format(", friction {:.4g} N", *scene.x().device.friction_n);
  if (scene.x().device.encoder_m)
    text += fmt::format("  ·  encoder {:.4g} mm", *scene.x().device.encoder_m * 1e3);
  if (scene.x().device.force_limit_n)
    text += fmt::format("  ·  force limit {:.4g} N", *scene.x().device.force_limit_n);
  return text;
}

Result<file::Picture> draw_figure(const Scene& scene, std::span<const Sample> samples,
                                  const Paper& paper, const SignalNames& signals,
                                  std::size_t axis) {
  SampleHistory history(samples.size(), scene.x().device.encoder_m);
  history.name_signals(signals);
  history.push(samples);
  const double from_s = history.oldest_time_s();
  FigureView view;
  // The last sample lasts a period.
  const double to_s = history.newest_time_s() + scene.sampling.period_s();
  view.window = {from_s, std::max(to_s, from_s + scene.sampling.period_s())};
  view.plots = kAllPlots;
  view.axis = axis;
  view.lines = lines_with(signals);
  return draw_figure(scene, history, view, paper);
}

Result<file::Picture> draw_figure(const Scene& scene, const SampleHistory& history,
                                  const FigureView& view, const Paper& paper) {
  // Drawing an axis writes to it.
  FigureView copy = view;
  PlotScratch scratch;
  PlotSurface surface;
  surface.history = &history;
  surface.walls = scene.x().walls;
  surface.window = &copy.window;
  surface.chosen = &copy.lines;
  surface.hidden = &copy.hidden;
  surface.axes = &copy.axes;
  surface.scratch = &scratch;
  surface.device = scene.x().device;
  surface.bounds = view.bounds;
  surface.extra_traces = view.extra_traces;
  surface.marks = view.marks;
  surface.interactive = false;
  surface.axis = view.axis;
  surface.line_names = false;  // the legend has them
  surface.line_weight = kPrintLineWeight * print_scale();
  surface.column = kColumnShare * surface.line_weight / kLineWeight;
  return draw_page(paper, [&](const Theme& theme) {
    surface.theme = &theme;
    draw_contents(scene, surface, copy, paper.narrow());
  });
}

}  // namespace hapticwall::draw
