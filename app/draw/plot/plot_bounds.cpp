#include "app/draw/plot/plot_bounds.h"

#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/draw/axis/dashes.h"
#include "app/draw/axis/symbol_text.h"

namespace hapticwall::draw {
namespace {

constexpr float kBoundLineWeight = 1.0F;
constexpr float kNearEms = 0.35F;

// Looks for a place above and below the line, from right to left.
std::optional<ImVec2> label_place(PlotInk& ink, const PixelBox& area, float y, ImVec2 size) {
  constexpr int kTries = 16;
  const float gap = 0.3F * ImGui::GetFontSize();
  const float step = (area.to.x - area.from.x - size.x - 2.0F * gap) / (kTries - 1);
  std::array<ImVec2, std::size_t{2} * kTries> corners;
  for (int i = 0; i < kTries; ++i) {
    const float x = area.to.x - gap - size.x - static_cast<float>(i) * step;
    corners[2 * static_cast<std::size_t>(i)] = {x, y - gap - size.y};
    corners[2 * static_cast<std::size_t>(i) + 1] = {x, y + gap};
  }
  return take_free_place(ink, area, size, corners);
}

// Bounds that stand within some pixels of each other are one line with one label, at the first
// of them.
std::vector<BoundLine> apart(const std::vector<BoundLine>& bounds, double scale) {
  const double x = ImPlot::GetPlotLimits().X.Min;
  const auto y_of = [&](const BoundLine& bound) {
    return ImPlot::PlotToPixels(x, bound.value * scale).y;
  };
  std::vector<BoundLine> result;
  for (const BoundLine& bound : bounds) {
    const bool near = !result.empty() &&
                      std::abs(y_of(result.back()) - y_of(bound)) < kNearEms * ImGui::GetFontSize();
    if (near) {
      result.back().label += ", " + bound.label;
    } else {
      result.push_back(bound);
    }
  }
  return result;
}

}  // namespace

std::vector<BoundLine> bound_lines(const StabilityBounds& bounds) {
  std::vector<BoundLine> lines;
  const auto add = [&](const char* label, const std::optional<double>& stiffness_n_per_m) {
    if (!stiffness_n_per_m) return;
    const auto equal = std::find_if(lines.begin(), lines.end(), [&](const BoundLine& line) {
      return line.value == *stiffness_n_per_m;
    });
    if (equal != lines.end()) {
      equal->label += std::string(", ") + label;
    } else {
      lines.push_back({label, *stiffness_n_per_m});
    }
  };
  add("passive", bounds.passive_n_per_m);
  add("stable", bounds.stable_n_per_m);
  add("friction", bounds.friction_n_per_m);
  add("resolution", bounds.resolution_n_per_m);
  std::stable_sort(lines.begin(), lines.end(),
                   [](const BoundLine& a, const BoundLine& b) { return a.value < b.value; });
  return lines;
}

void draw_bounds(const Theme& theme, const std::vector<BoundLine>& all, double scale,
                 PlotInk& ink) {
  const std::vector<BoundLine> bounds = apart(all, scale);
  const ImPlotRect limits = ImPlot::GetPlotLimits();
  ImDrawList* list = ImPlot::GetPlotDrawList();
  const float font_scale = ImGui::GetStyle().FontScaleMain;
  const ImVec2 corner = ImPlot::GetPlotPos();
  const PixelBox area{corner,
                      {corner.x + ImPlot::GetPlotSize().x, corner.y + ImPlot::GetPlotSize().y}};
  const auto y_of = [&](const BoundLine& bound) {
    return ImPlot::PlotToPixels(limits.X.Min, bound.value * scale).y;
  };
  ImPlot::PushPlotClipRect();
  for (const BoundLine& bound : bounds) {
    const std::array line{ImVec2(area.from.x, y_of(bound)), ImVec2(area.to.x, y_of(bound))};
    draw_dashed(list, line, theme.packed(Tone::kText, 0.8F), kBoundLineWeight * font_scale,
                Dash::kDashed, font_scale);
    ink.take(line, kBoundLineWeight * font_scale);
  }
  for (const BoundLine& bound : bounds) {
    if (!limits.Y.Contains(bound.value * scale)) continue;
    const ImVec2 size = symbol_text_size(bound.label);
    if (const auto place = label_place(ink, area, y_of(bound), size))
      add_symbol_text(*list, *place, theme.packed(Tone::kText, 0.9F), bound.label);
  }
  ImPlot::PopPlotClipRect();
}

}  // namespace hapticwall::draw
