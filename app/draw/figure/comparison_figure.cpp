#include "app/draw/figure/comparison_figure.h"

#include <fmt/format.h>
#include <imgui.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/axis/axis_titles.h"
#include "app/draw/axis/symbol_text.h"
#include "app/draw/figure/column_name.h"
#include "app/draw/figure/page.h"
#include "app/draw/plot/plot.h"
#include "app/draw/plot/plot_heading.h"
#include "app/draw/plot/theme.h"
#include "app/file/text/verdict.h"
#include "core/algorithm/algorithm.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr float kComparisonLineWeight = 1.0F;  // pixels at scale 1: 0.65 pt
constexpr float kFigureColumnGapEms = 1.4F;
// Height of a plot by the number of bands below the first one: three of them fit on a page of A4.
constexpr std::array kPanelMm{21.0, 17.0, 13.0};

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
  std::size_t columns = 1;
  PlotSurface surface;
  float titles = 0.0F;  // room of the upright titles
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
  return {found.minimum, found.maximum + scene.sampling.period_s()};
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
    std::vector<double> amplitudes;
    for (const ComparedRun& run : comparison.runs) {
      if (!stretches_axes(run, comparison.runs)) continue;
      surface.history = &run.history;
      const Extremes shown = shown_values(surface, plot_description(id));
      include(values, shown);
      amplitudes.push_back(std::max(std::abs(shown.minimum), std::abs(shown.maximum)) *
                           plot_description(id).left.scale);
    }
    if (!values) continue;
    PlotAxes& axes = (*surface.axes)[static_cast<std::size_t>(id)];
    if (id == PlotId::kPassivity) axes.knee = comparison_knee(amplitudes);
    fit_left_axis(surface, plot_description(id), *values);
    axes.left.manual = true;
  }
}

void draw_title(const Theme& theme, const Comparison& comparison) {
  const Scene& scene = comparison.scene;
  const std::size_t runs = comparison.runs.size();
  strong_text(theme, scene.name, kTitleFontSize);
  const FontScope font(nullptr, kSmallFontSize);
  const std::string follower =
      has_follower(scene.algorithm) ? ", each with a passivity controller behind it" : "";
  const bool symlog =
      (*comparison.surface.axes)[static_cast<std::size_t>(PlotId::kPassivity)].knee > 0.0;
  const ImU32 muted = theme.packed(Tone::kMuted);
  wrapped_symbol_text(
      muted, fmt::format("compared: {} run{}{}{}  ·  {}", runs, runs == 1 ? "" : "s", follower,
                         scene.two_axes() ? "  ·  axis x" : "", describe(scene)));
  wrapped_symbol_text(
      muted,
      fmt::format("numbers of the last second: peak to peak, displayed stiffness, mean "
                  "force ± its standard deviation  ·  all runs have the same axes{}",
                  symlog ? "; that of energy is linear around 0 and logarithmic beyond" : ""));
}

// The last second: its motion, its stiffness and its force.
std::vector<std::string> tail_lines(const Summary& summary, bool stretches, float width) {
  if (!summary.tail_peak_to_peak_m || summary.verdict == Verdict::kDiverged) {
    return {"no last second", stretches ? "" : "the axes do not follow it"};
  }
  const file::TailTexts texts = file::tail_texts(summary);
  const std::string both = fmt::format("{} · {}", texts.way, texts.stiffness);
  if (ImGui::CalcTextSize(both.c_str()).x <= width) return {both, texts.force};
  return {texts.way, texts.stiffness, texts.force};
}

void draw_run_heading(const Theme& theme, const Comparison& comparison, const ComparedRun& run,
                      float width) {
  const Summary& summary = run.summary;
  ImGui::BeginGroup();
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
  // A column's name ends at the first space. The figure's title names the follower of all runs, as
  // "(held-force)".
  draw_column_name(theme, summary.algorithm.substr(0, summary.algorithm.find(' ')), width);
  const std::string form =
      summary.algorithm.substr(std::min(summary.algorithm.find('('), summary.algorithm.size()));
  ImGui::TextColored(theme.colour(verdict_tone(summary.verdict)), "%s  %s",
                     file::verdict_text(summary).c_str(), form.c_str());
  const FontScope font(nullptr, kSmallFontSize);
  const bool stretches = stretches_axes(run, comparison.runs);
  for (const std::string& text : tail_lines(summary, stretches, width)) {
    if (!text.empty()) ImGui::TextUnformatted(text.c_str());
  }
  ImGui::PopTextWrapPos();
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

// The upright titles stand at the left, then the labels, then the columns.
Columns place_columns(const Comparison& comparison, float left, float width) {
  const float gap = kFigureColumnGapEms * ImGui::GetFontSize();
  const float labels = comparison.titles + *std::ranges::max_element(comparison.label_widths);
  const auto count = static_cast<float>(comparison.columns);
  const float each = std::max(1.0F, (width - labels - gap * (count - 1.0F)) / count);
  return {left + labels, each, each + gap};
}

// Some runs, in a band of plots.
struct Band {
  std::size_t first = 0;
  std::size_t count = 0;
};

// Only the first column has labels. Their width is known once it is drawn.
void draw_row(Comparison& comparison, std::size_t row, const Band& band, const Columns& columns,
              float height) {
  PlotSurface& surface = comparison.surface;
  const PlotDescription& plot = plot_description(kAllPlots[row]);
  float& labels = comparison.label_widths[row];
  const ImVec2 start = ImGui::GetCursorScreenPos();
  PlotArea first;
  for (std::size_t i = 0; i < band.count; ++i) {
    surface.history = &comparison.runs[band.first + i].history;
    surface.value_labels = i == 0;
    const float room = i == 0 ? labels : 0.0F;
    ImGui::SetCursorScreenPos(ImVec2(columns.at(i) - room, start.y));
    ImGui::PushID(static_cast<int>(band.first + i));
    const PlotArea area = draw_plot(surface, plot, "", ImVec2(columns.width + room, height));
    ImGui::PopID();
    if (i == 0) first = area;
  }
  draw_upright_title(surface.theme->packed(Tone::kText),
                     axis_title(surface, in_shown_units(surface, plot)), start.x, comparison.titles,
                     first.position.y, first.size.y);
  // The area of the first column is as far to the right as those of the others.
  const float padding = ImPlot::GetStyle().PlotPadding.x;
  labels = std::max(0.0F, labels + first.position.x - columns.at(0) - padding);
  ImGui::SetCursorScreenPos(ImVec2(start.x, start.y + height));
}

float panel_height(const Comparison& comparison) {
  const std::size_t more =
      (std::max<std::size_t>(comparison.runs.size(), 1) - 1) / comparison.columns;
  return pixels_of_mm(kPanelMm.at(std::min(more, kPanelMm.size() - 1)));
}

// The same for all rows.
float shared_title_room(const Comparison& comparison) {
  constexpr float kAreaShare = 0.85F;  // of the height, left by the padding
  float room = 0.0F;
  for (const PlotId id : kAllPlots) {
    const PlotDescription plot = in_shown_units(comparison.surface, plot_description(id));
    room = std::max(room, title_room(axis_title(comparison.surface, plot),
                                     kAreaShare * panel_height(comparison)));
  }
  return room;
}

void draw_rows(Comparison& comparison, const Band& band, const Columns& columns) {
  PlotSurface& surface = comparison.surface;
  const float time_axis = 2.5F * ImGui::GetFontSize();
  const float panel = panel_height(comparison);
  for (std::size_t row = 0; row < kAllPlots.size(); ++row) {
    surface.time_labels = row + 1 == kAllPlots.size();
    const float more = surface.time_labels ? time_axis : 0.0F;
    draw_row(comparison, row, band, columns, panel + more);
  }
}

void draw_band(const Theme& theme, Comparison& comparison, const Band& band,
               const Columns& columns) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float padding = ImPlot::GetStyle().PlotPadding.x;
  float bottom = corner.y;
  for (std::size_t i = 0; i < band.count; ++i) {
    ImGui::SetCursorScreenPos(ImVec2(columns.at(i) + padding, corner.y));
    draw_run_heading(theme, comparison, comparison.runs[band.first + i], columns.width);
    bottom = std::max(bottom, ImGui::GetCursorScreenPos().y);
  }
  ImGui::SetCursorScreenPos(ImVec2(corner.x, bottom));
  draw_rows(comparison, band, columns);
}

// The lines of all plots, once.
void draw_shared_legend(Comparison& comparison) {
  if (comparison.runs.empty()) return;
  PlotSurface& surface = comparison.surface;
  surface.history = &comparison.runs.front().history;
  std::vector<LegendOf> plots;
  for (const PlotId id : kAllPlots) {
    const PlotDescription plot = in_shown_units(surface, plot_description(id));
    const PlotAxes& axes = (*surface.axes)[static_cast<std::size_t>(id)];
    plots.push_back({plot, hand_outside(surface, plot, axes.left.maximum)});
  }
  draw_plot_legends(surface, plots, ImGui::GetContentRegionAvail().x);
}

void draw_contents(const Theme& theme, Comparison& comparison) {
  comparison.surface.theme = &theme;
  draw_title(theme, comparison);
  draw_shared_legend(comparison);
  ImGui::Spacing();
  comparison.titles = shared_title_room(comparison);
  const Columns columns =
      place_columns(comparison, ImGui::GetCursorScreenPos().x, ImGui::GetContentRegionAvail().x);
  for (std::size_t first = 0; first < comparison.runs.size(); first += comparison.columns) {
    const Band band{first, std::min(comparison.columns, comparison.runs.size() - first)};
    draw_band(theme, comparison, band, columns);
  }
  ImGui::Dummy(ImVec2());  // the only item if there is no run
}

}  // namespace

std::size_t compared_columns(const Paper& paper, std::size_t runs) {
  return std::clamp<std::size_t>(runs, 1, paper.narrow() ? 2 : 4);
}

double comparison_knee(std::span<const double> amplitudes) {
  constexpr double kSeenShare = 0.1;  // of the largest amplitude: seen on a linear axis
  constexpr double kBelow = 0.1;      // of the smallest amplitude, so that it is no line
  constexpr double kMinShare = 1e-6;  // of the largest amplitude; below it is round-off
  if (amplitudes.empty()) return 0.0;
  const auto [least, most] = std::ranges::minmax(amplitudes);
  if (!(least < kSeenShare * most)) return 0.0;
  return std::pow(10.0, std::floor(std::log10(std::max(kBelow * least, kMinShare * most))));
}

Result<file::Picture> draw_comparison(const Scene& scene, std::span<const ComparedRun> runs,
                                      const Paper& paper) {
  TimeWindow window = whole_window(scene, runs);
  ChosenLines lines = compared_lines();
  HiddenLines hidden = 0;
  AllPlotAxes axes;
  PlotScratch scratch;
  Comparison comparison{scene, runs, compared_columns(paper, runs.size()), {}, 0.0F, {}};
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
  surface.line_weight = kComparisonLineWeight * print_scale();
  surface.column = kColumnShare * surface.line_weight / kLineWeight;
  share_axes(comparison);
  return draw_page(paper, [&](const Theme& theme) { draw_contents(theme, comparison); });
}

}  // namespace hapticwall::draw
