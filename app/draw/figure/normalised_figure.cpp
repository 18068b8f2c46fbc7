#include "app/draw/figure/normalised_figure.h"

#include <fmt/format.h>
#include <imgui.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "app/draw/figure/page.h"
#include "app/draw/plot/log_plot.h"
#include "app/draw/plot/plot_axes.h"
#include "app/draw/plot/theme.h"
#include "core/study/stability_bounds.h"

namespace hapticwall::draw {
namespace {

constexpr float kChartDesignHeight = 700.0F;  // figure of scale 1
constexpr float kLimitWeight = 2.0F;
constexpr float kRuleWeight = 0.7F;
constexpr float kPointRadius = 4.5F;

// One for each delay.
constexpr std::array kTones{Tone::kPosition, Tone::kForce, Tone::kGood};
constexpr std::array kMarks{Mark::kCircle, Mark::kSquare, Mark::kDiamond};
constexpr std::array kMarkers{ImPlotMarker_Circle, ImPlotMarker_Square, ImPlotMarker_Diamond};
static_assert(kTones.size() == kMaxChartDelay + 1);

void draw_line(const std::vector<ChartPoint>& points, double ChartPoint::*height,
               const std::string& name, const ImVec4& colour, float weight) {
  ImPlotSpec spec = line_spec(colour);
  spec.LineWeight = weight;
  std::vector<double> x;
  std::vector<double> y;
  for (const ChartPoint& point : points) {
    if (!(point.*height > 0.0)) continue;  // the axis is logarithmic
    x.push_back(point.damping);
    y.push_back(point.*height);
  }
  ImPlot::PlotLine(name.c_str(), x.data(), y.data(), static_cast<int>(x.size()), spec);
}

void draw_delay(const Theme& theme, const DelayChart& delay, std::size_t index, float scale) {
  const ImVec4 colour = theme.colour(kTones.at(index));
  draw_line(delay.curve, &ChartPoint::limit, fmt::format("##limit{}", index), colour,
            kLimitWeight * scale);
  draw_line(delay.curve, &ChartPoint::rule, fmt::format("##rule{}", index), colour,
            kRuleWeight * scale);
  ImPlotSpec spec = line_spec(colour);
  spec.Marker = kMarkers.at(index);
  spec.MarkerSize = kPointRadius * scale;
  spec.MarkerLineColor = colour;
  spec.MarkerFillColor = theme.colour(Tone::kBackground);
  for (std::size_t i = 0; i < delay.points.size(); ++i) {
    const SimulatedPoint& point = delay.points[i];
    if (!point.settled) continue;
    ImPlot::PlotScatter(fmt::format("##point{}-{}", index, i).c_str(), &point.damping,
                        &*point.settled, 1, spec);
  }
}

void draw_plot(const Theme& theme, const NormalisedChart& chart, ImVec2 size, float scale) {
  double right = 0.0;
  double top = 0.0;
  double bottom = std::numeric_limits<double>::infinity();
  for (const DelayChart& delay : chart.delays) {
    constexpr double kLeastShare = 0.05;  // of the best, if a wall without damping is not stable
    const double first = delay.curve.empty() ? 0.0 : delay.curve.front().limit;
    right = std::max(right, delay.last_damping);
    top = std::max(top, delay.best.limit);
    bottom = std::min(bottom, std::max(first, kLeastShare * delay.best.limit));
  }
  constexpr double kRoom = 1.05;
  if (!ImPlot::BeginPlot("##chart", size, ImPlotFlags_CanvasOnly | ImPlotFlags_NoInputs)) return;
  ImPlot::SetupAxis(ImAxis_X1, "damping of the wall, B T/m", kAxisFlags);
  ImPlot::SetupAxis(ImAxis_Y1, "stiffness of the wall, K T²/m", kAxisFlags);
  ImPlot::SetupAxisScale(ImAxis_Y1, ImPlotScale_Log10);
  ImPlot::SetupAxisFormat(ImAxis_Y1, "%g");
  ImPlot::SetupAxisLimits(ImAxis_X1, -0.02 * right, kRoom * right, ImPlotCond_Always);
  ImPlot::SetupAxisLimits(ImAxis_Y1, 0.5 * bottom, 3.0 * top, ImPlotCond_Always);
  for (std::size_t i = 0; i < chart.delays.size(); ++i) {
    draw_delay(theme, chart.delays[i], i, scale);
  }
  ImPlot::EndPlot();
}

void draw_legend(const Theme& theme, const NormalisedChart& chart) {
  const FontScope font(nullptr, kSmallFontSize);
  const float gap = 1.6F * ImGui::GetFontSize();
  for (std::size_t i = 0; i < chart.delays.size(); ++i) {
    draw_legend_mark(theme, kTones.at(i), kMarks.at(i), false);
    ImGui::TextColored(theme.colour(kTones.at(i)), "delay %d %s", chart.delays[i].ticks,
                       chart.delays[i].ticks == 1 ? "tick" : "ticks");
    ImGui::SameLine(0.0F, gap);
  }
  ImGui::TextDisabled(
      "line: stable below, by eigenvalues     marks: stiffest wall that settles in the simulator");
  ImGui::TextDisabled("thin line: K = (b + B) / (T/2 + t_d), a rule for B T/m < %g",
                      kMaxRuleDamping);
}

void draw_contents(const Theme& theme, const NormalisedChart& chart, float scale) {
  const DeviceSettings& device = chart.handle.x().device;
  strong_text(theme, chart.handle.name, kTitleFontSize);
  ImGui::SameLine();
  ImGui::TextDisabled("  stability of a bare wall, normalised");
  {
    const FontScope font(nullptr, kSmallFontSize);
    ImGui::TextDisabled(
        "handle: m = %.4g kg, b = %.4g N·s/m, 1/T = %g Hz, b T/m = %.3g; no hand, friction or "
        "encoder",
        device.mass_kg, device.damping_n_s_per_m, chart.handle.sampling.rate_hz,
        chart.device_damping);
  }
  draw_legend(theme, chart);
  ImGui::Spacing();
  draw_plot(theme, chart, ImGui::GetContentRegionAvail(), scale);
}

}  // namespace

Result<file::Picture> draw_normalised(const NormalisedChart& chart, FigureSize size) {
  const float scale = static_cast<float>(size.height) / kChartDesignHeight;
  return draw_page(size, scale, [&](const Theme& theme) { draw_contents(theme, chart, scale); });
}

}  // namespace hapticwall::draw
