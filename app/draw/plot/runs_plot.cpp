#include "app/draw/plot/runs_plot.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <ranges>

#include "app/draw/plot/plot_axes.h"
#include "app/draw/plot/plot_bounds.h"

namespace hapticwall::draw {
namespace {

constexpr float kLineWidth = 2.0F;  // pixels at scale 1
constexpr float kWallShade = 0.12F;
constexpr float kNameGapEms = 1.2F;
constexpr float kUnitGapEms = 0.5F;

IndexRange range_of(const RunsPlot& shown, const ShownRun& run) {
  return run.history.range(shown.window.from_s, shown.window.to_s);
}

Extremes values_of(const RunsPlot& shown) {
  std::optional<Extremes> all;
  for (const ShownRun& run : shown.runs) {
    const IndexRange range = range_of(shown, run);
    if (range.count() == 0) continue;
    const SampleStats stats = run.history.stats(shown.quantity, range);
    if (!stats.empty()) include(all, stats.extremes);
  }
  if (!shown.walls.empty()) {
    const double face_m = shown.walls.front().position_m;
    include(all, {face_m, face_m});
  } else {
    include(all, {});
  }
  return *all;
}

std::string name_of(const ShownRun& run) { return run.dashed ? "– – " + run.name : run.name; }

// Names at the right edge, each in the colour of its line, if they fit beside the title.
void draw_names(const RunsPlot& shown, ImVec2 corner, float title, float width) {
  const FontScope font(nullptr, kSmallFontSize);
  float names = title;
  for (const ShownRun& run : shown.runs)
    names += ImGui::CalcTextSize(name_of(run).c_str()).x + ems(kNameGapEms);
  if (names > width) return;
  float right = corner.x + width;
  for (const ShownRun& run : std::views::reverse(shown.runs)) {
    const std::string name = name_of(run);
    right -= ImGui::CalcTextSize(name.c_str()).x;
    ImGui::SetCursorScreenPos(ImVec2(right, corner.y));
    ImGui::TextColored(shown.theme.colour(run.tone), "%s", name.c_str());
    right -= ems(kNameGapEms);
  }
}

void draw_heading(const RunsPlot& shown, float width) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  strong_text(shown.theme, shown.plot.title);
  ImGui::SameLine(0.0F, ems(kUnitGapEms));
  ImGui::TextColored(shown.theme.colour(Tone::kMuted), "%s", shown.plot.left.unit);
  const float below = ImGui::GetCursorScreenPos().y;
  draw_names(shown, corner, ImGui::GetItemRectMax().x - corner.x, width);
  ImGui::SetCursorScreenPos(ImVec2(corner.x, below));
}

void draw_walls(const RunsPlot& shown) {
  const ImPlotRect limits = ImPlot::GetPlotLimits();
  ImDrawList* list = ImPlot::GetPlotDrawList();
  ImPlot::PushPlotClipRect();
  for (const WallSettings& wall : shown.walls) {
    const double face = wall.position_m * shown.plot.left.scale;
    const ImVec2 left = ImPlot::PlotToPixels(limits.X.Min, face);
    const ImVec2 right = ImPlot::PlotToPixels(limits.X.Max, std::max(limits.Y.Max, face));
    list->AddRectFilled(ImVec2(left.x, right.y), ImVec2(right.x, left.y),
                        shown.theme.packed(Tone::kWall, kWallShade));
  }
  ImPlot::PopPlotClipRect();
}

void draw_lines(const RunsPlot& shown, PlotScratch& scratch) {
  scratch.ink.clear();
  const float weight = kLineWidth * ImGui::GetStyle().FontScaleMain;
  for (const ShownRun& run : shown.runs) {
    const IndexRange range = range_of(shown, run);
    if (range.count() == 0) continue;
    const TraceStyle style{run.name.c_str(), shown.theme.colour(run.tone), weight,
                           run.dashed ? Dash::kDashed : Dash::kSolid,
                           shown.plot.left.smallest_span};
    draw_trace({run.history, shown.quantity, range, shown.plot.left.scale}, style, ImAxis_Y1,
               scratch);
  }
}

}  // namespace

void draw_runs_plot(const RunsPlot& shown, PlotScratch& scratch, ImVec2 size) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  draw_heading(shown, size.x);
  const float height = std::max(1.0F, size.y - (ImGui::GetCursorScreenPos().y - corner.y));
  const FontScope font(nullptr, kSmallFontSize);
  const ImPlotFlags flags = plot_flags(false);
  if (!ImPlot::BeginPlot(fmt::format("##runs {}", shown.plot.title).c_str(), ImVec2(size.x, height),
                         flags))
    return;
  const Extremes values = values_of(shown);
  const double scale = shown.plot.left.scale;
  const Extremes shown_values =
      round_range({values.minimum * scale, values.maximum * scale}, shown.plot.left.smallest_span);
  double length_s = shown.window.length_s();
  ImPlot::SetupAxis(ImAxis_X1, nullptr, kAxisFlags);
  ImPlot::SetupAxisLimits(ImAxis_X1, shown.window.from_s, shown.window.to_s, ImPlotCond_Always);
  ImPlot::SetupAxisFormat(ImAxis_X1, format_time, &length_s);
  ImPlot::SetupAxis(ImAxis_Y1, nullptr, kAxisFlags);
  ImPlot::SetupAxisLimits(ImAxis_Y1, shown_values.minimum, shown_values.maximum, ImPlotCond_Always);
  ImPlot::SetupAxisFormat(ImAxis_Y1, "%6.6g");
  ImPlot::SetupFinish();
  draw_walls(shown);
  draw_lines(shown, scratch);
  ImPlot::EndPlot();
}

}  // namespace hapticwall::draw
