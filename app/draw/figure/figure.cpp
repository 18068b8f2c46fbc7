#include "app/draw/figure/figure.h"

#include <fmt/format.h>
#include <imgui.h>
#include <implot.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/draw/figure/page.h"
#include "app/draw/plot/phase_plot.h"
#include "app/draw/plot/plot.h"
#include "app/draw/plot/theme.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::draw {
namespace {

constexpr float kFigureDesignHeight = 880.0F;  // px, at figure scale 1
constexpr float kPrintLineWeight = 1.2F;
constexpr float kPhaseShare = 0.38F;  // share of the width for the plot of force over penetration

void draw_title(const Theme& theme, const Scene& scene) {
  const auto list = algorithms();
  const bool known = scene.algorithm.index < list.size();
  strong_text(theme,
              fmt::format("{}  ·  {}", scene.name, known ? algorithm_label(scene.algorithm) : "?"),
              kTitleFontSize);
  if (known) {
    ImGui::SameLine();
    ImGui::TextDisabled("  %s", std::string(list[scene.algorithm.index].title).c_str());
  }
  const FontScope font(nullptr, kSmallFontSize);
  ImGui::TextDisabled("%s", describe(scene).c_str());
}

void draw_plots(PlotSurface& surface, std::span<const PlotId> plots, ImVec2 free) {
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  const auto count = static_cast<float>(plots.size());
  const ImVec2 each(free.x, (free.y - (count - 1.0F) * gap) / count);
  const PlotTable table(surface.history->signals());
  ImPlot::BeginAlignedPlots("plots");  // gives all plots one left and one right margin
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const std::string mark = fmt::format("({}) ", static_cast<char>('a' + i));
    surface.time_labels = i + 1 == plots.size();
    draw_plot(surface, table[plots[i]], mark, each);
  }
  ImPlot::EndAlignedPlots();
}

void draw_contents(const Scene& scene, PlotSurface& surface, const FigureView& view) {
  draw_title(*surface.theme, scene);
  ImGui::Spacing();
  ImVec2 free = ImGui::GetContentRegionAvail();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (view.phase.shown) {
    const float side = std::min(free.y, kPhaseShare * free.x);
    const float gap = 2.0F * ImGui::GetFontSize();
    ImGui::SetCursorScreenPos(ImVec2(corner.x + free.x - side, corner.y));
    PhaseSettings settings = view.phase;
    PhaseView memory;
    draw_phase_plot(surface, settings, memory, ImVec2(side, side));
    ImGui::SetCursorScreenPos(corner);
    free.x -= side + gap;
  }
  draw_plots(surface, view.plots, free);
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
                                  FigureSize size, const SignalNames& signals) {
  SampleHistory history(samples.size(), scene.x().device.encoder_m);
  history.name_signals(signals);
  history.push(samples);
  const double from_s = history.oldest_time_s();
  FigureView view;
  view.window = {from_s, std::max(history.newest_time_s(), from_s + scene.sampling.period_s())};
  view.plots = kAllPlots;
  view.lines = lines_with(signals);
  return draw_figure(scene, history, view, size);
}

Result<file::Picture> draw_figure(const Scene& scene, const SampleHistory& history,
                                  const FigureView& view, FigureSize size) {
  const float scale = static_cast<float>(size.height) / kFigureDesignHeight;
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
  surface.line_weight = kPrintLineWeight * scale;
  return draw_page(size, scale, [&](const Theme& theme) {
    surface.theme = &theme;
    draw_contents(scene, surface, copy);
  });
}

}  // namespace hapticwall::draw
