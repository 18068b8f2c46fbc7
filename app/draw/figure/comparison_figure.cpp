#include "app/draw/figure/comparison_figure.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/figure/page.h"
#include "app/draw/plot/plot.h"
#include "app/draw/plot/plot_heading.h"
#include "app/draw/plot/theme.h"
#include "app/file/text/verdict.h"
#include "core/algorithm/algorithm.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr int kFigureWidth = 2400;  // pixels, of up to kUsualRuns columns
constexpr int kFigureHeight = 1400;
constexpr std::size_t kUsualRuns = 8;
constexpr int kColumnWidth = 290;               // pixels for each column above kUsualRuns
constexpr float kComparisonDesignHeight = 900;  // px, at figure scale 1
constexpr float kComparisonLineWeight = 1.1F;
constexpr float kFigureColumnGapEms = 1.0F;

// Lines of a comparison. The force plot has the actuator's force alone: the force of a soft wall
// would flatten it.
ChosenLines compared_lines() {
  ChosenLines lines = usual_lines();
  lines[static_cast<std::size_t>(PlotId::kForce)] = line_bit(&Sample::force_n);
  return lines;
}

// The comparison, the same for every frame of the page.
struct Comparison {
  const Scene& scene;
  std::span<const ComparedRun> runs;
  PlotSurface surface;
  // Widths of the labels beside the first column; known after one frame.
  std::array<float, kAllPlots.size()> label_widths{};
};

// The whole of the longest run.
TimeWindow whole_window(const Scene& scene, std::span<const ComparedRun> runs) {
  std::optional<Extremes> times;
  for (const ComparedRun& run : runs) {
    if (run.history.empty()) continue;
    include(times, {run.history.oldest_time_s(), run.history.newest_time_s()});
  }
  const Extremes found = times.value_or(Extremes{});
  return {found.minimum, std::max(found.maximum, found.minimum + scene.sampling.period_s())};
}

// A diverged run would flatten all others.
bool stretches_axes(const ComparedRun& run, std::span<const ComparedRun> runs) {
  return run.summary.verdict != Verdict::kDiverged ||
         std::ranges::all_of(runs, [](const ComparedRun& other) {
           return other.summary.verdict == Verdict::kDiverged;
         });
}

void share_axes(Comparison& comparison) {
  PlotSurface& surface = comparison.surface;
  for (const PlotId id : kAllPlots) {
    std::optional<Extremes> values;
    for (const ComparedRun& run : comparison.runs) {
      if (!stretches_axes(run, comparison.runs)) continue;
      surface.history = &run.history;
      include(values, shown_values(surface, plot_description(id)));
    }
    if (!values) continue;
    fit_left_axis(surface, plot_description(id), *values);
    (*surface.axes)[static_cast<std::size_t>(id)].left.manual = true;
  }
}

void draw_title(const Theme& theme, const Scene& scene, std::size_t runs) {
  strong_text(theme, scene.name, kTitleFontSize);
  ImGui::SameLine();
  ImGui::TextDisabled(
      "  compared: %zu run%s%s%s", runs, runs == 1 ? "" : "s",
      has_follower(scene.algorithm) ? ", each with a passivity controller behind it" : "",
      scene.two_axes() ? "  ·  axis x" : "");
  const FontScope font(nullptr, kSmallFontSize);
  ImGui::TextDisabled("%s", describe(scene).c_str());
  ImGui::TextDisabled(
      "numbers of the last second: peak to peak, displayed stiffness, mean force ± its standard "
      "deviation  ·  the axes are the same along each row");
}

// The last second in two lines: its motion and its force.
std::array<std::string, 2> tail_lines(const Summary& summary, bool stretches) {
  if (!summary.tail_peak_to_peak_m || summary.verdict == Verdict::kDiverged) {
    return {"no last second", stretches ? "" : "the axes do not follow it"};
  }
  const file::TailTexts texts = file::tail_texts(summary);
  return {fmt::format("{} · {}", texts.way, texts.stiffness), texts.force};
}

void draw_run_heading(const Theme& theme, const Comparison& comparison, const ComparedRun& run) {
  const Summary& summary = run.summary;
  ImGui::BeginGroup();
  // A column's name ends at the first space. The figure's title names the follower of all runs, as
  // "(held-force)".
  strong_text(theme, summary.algorithm.substr(0, summary.algorithm.find(' ')));
  const std::string form =
      summary.algorithm.substr(std::min(summary.algorithm.find('('), summary.algorithm.size()));
  ImGui::TextColored(theme.colour(verdict_tone(summary.verdict)), "%s  %s",
                     file::verdict_text(summary).c_str(), form.c_str());
  ImGui::PushFont(nullptr, kSmallFontSize);
  const bool stretches = stretches_axes(run, comparison.runs);
  for (const std::string& text : tail_lines(summary, stretches))
    ImGui::TextUnformatted(text.c_str());
  ImGui::PopFont();
  ImGui::EndGroup();
}

// Places of the columns.
struct Columns {
  float left = 0.0F;   // left edge of the first column's plot area, without ImPlot's padding
  float width = 0.0F;  // width of each column
  float step = 0.0F;   // distance from one column to the next

  [[nodiscard]] float at(std::size_t column) const {
    return left + step * static_cast<float>(column);
  }
};

Columns place_columns(const Comparison& comparison, float left, float width) {
  const float gap = kFigureColumnGapEms * ImGui::GetFontSize();
  const float labels = *std::ranges::max_element(comparison.label_widths);
  const auto count = static_cast<float>(std::max<std::size_t>(comparison.runs.size(), 1));
  const float each = std::max(1.0F, (width - labels - gap * (count - 1.0F)) / count);
  return {left + labels, each, each + gap};
}

// Only the first column has labels. Their width is known once two columns are drawn.
void draw_row(Comparison& comparison, std::size_t row, const Columns& columns, float height) {
  PlotSurface& surface = comparison.surface;
  const PlotDescription& plot = plot_description(kAllPlots[row]);
  float& labels = comparison.label_widths[row];
  const float top = ImGui::GetCursorScreenPos().y;
  std::array<float, 2> areas{};
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    surface.history = &comparison.runs[i].history;
    surface.value_labels = i == 0;
    const float room = i == 0 ? labels : 0.0F;
    ImGui::SetCursorScreenPos(ImVec2(columns.at(i) - room, top));
    ImGui::PushID(static_cast<int>(i));
    const PlotArea area = draw_plot(surface, plot, "", ImVec2(columns.width + room, height));
    ImGui::PopID();
    if (i < areas.size()) areas[i] = area.size.x;
  }
  if (comparison.runs.size() > 1) labels = std::max(0.0F, labels + areas[1] - areas[0]);
}

std::string row_note(Comparison& comparison, const PlotDescription& plot) {
  if (comparison.runs.empty()) return {};
  comparison.surface.history = &comparison.runs.front().history;
  const PlotAxes& axes = (*comparison.surface.axes)[static_cast<std::size_t>(plot.id)];
  return hand_outside(comparison.surface, plot, axes.left.maximum);
}

void draw_rows(Comparison& comparison, const Columns& columns, float left, ImVec2 free) {
  PlotSurface& surface = comparison.surface;
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  const auto count = static_cast<float>(kAllPlots.size());
  const float each = (free.y - (count - 1.0F) * gap) / count;
  const float top = ImGui::GetCursorScreenPos().y;
  for (std::size_t row = 0; row < kAllPlots.size(); ++row) {
    const PlotDescription plot = in_shown_units(surface, plot_description(kAllPlots[row]));
    const float row_top = top + static_cast<float>(row) * (each + gap);
    ImGui::SetCursorScreenPos(ImVec2(left, row_top));
    draw_plot_heading(surface, plot, fmt::format("({}) ", static_cast<char>('a' + row)),
                      row_note(comparison, plot), free.x);
    surface.time_labels = row + 1 == kAllPlots.size();
    const float used = ImGui::GetCursorScreenPos().y - row_top;
    draw_row(comparison, row, columns, std::max(1.0F, each - used));
  }
  ImGui::Dummy(ImVec2());  // the only item if there is no run
}

void draw_contents(const Theme& theme, Comparison& comparison) {
  comparison.surface.theme = &theme;
  draw_title(theme, comparison.scene, comparison.runs.size());
  ImGui::Spacing();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const Columns columns = place_columns(comparison, corner.x, ImGui::GetContentRegionAvail().x);
  float bottom = corner.y;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    ImGui::SetCursorScreenPos(ImVec2(columns.at(i), corner.y));
    draw_run_heading(theme, comparison, comparison.runs[i]);
    bottom = std::max(bottom, ImGui::GetCursorScreenPos().y);
  }
  ImGui::SetCursorScreenPos(ImVec2(corner.x, bottom));
  ImGui::Spacing();
  draw_rows(comparison, columns, corner.x, ImGui::GetContentRegionAvail());
}

}  // namespace

FigureSize comparison_size(std::size_t runs) {
  const std::size_t more = std::max(runs, kUsualRuns) - kUsualRuns;
  return {kFigureWidth + static_cast<int>(more) * kColumnWidth, kFigureHeight};
}

Result<file::Picture> draw_comparison(const Scene& scene, std::span<const ComparedRun> runs,
                                      FigureSize size) {
  const float scale = static_cast<float>(size.height) / kComparisonDesignHeight;
  TimeWindow window = whole_window(scene, runs);
  ChosenLines lines = compared_lines();
  HiddenLines hidden = 0;
  AllPlotAxes axes;
  PlotScratch scratch;
  Comparison comparison{scene, runs, {}, {}};
  PlotSurface& surface = comparison.surface;
  surface.walls = scene.x().walls;
  surface.window = &window;
  surface.chosen = &lines;
  surface.hidden = &hidden;
  surface.axes = &axes;
  surface.scratch = &scratch;
  surface.device = scene.x().device;
  surface.interactive = false;
  surface.heading = false;
  surface.line_names = false;
  surface.line_weight = kComparisonLineWeight * scale;
  share_axes(comparison);
  return draw_page(size, scale, [&](const Theme& theme) { draw_contents(theme, comparison); });
}

}  // namespace hapticwall::draw
