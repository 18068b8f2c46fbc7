#include "app/draw/plot/plot_bounds.h"

#include <implot.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace hapticwall::draw {
namespace {

constexpr float kBoundLineWeight = 1.0F;
constexpr float kDash = 6.0F;  // pixels at scale 1
constexpr float kGap = 4.0F;

void draw_dashes(ImDrawList* list, ImVec2 from, float to_x, ImU32 colour, float scale) {
  const float step = (kDash + kGap) * scale;
  const int count = static_cast<int>(std::ceil((to_x - from.x) / step));
  for (int i = 0; i < count; ++i) {
    const float x = from.x + static_cast<float>(i) * step;
    list->AddLine(ImVec2(x, from.y), ImVec2(std::min(x + kDash * scale, to_x), from.y), colour,
                  kBoundLineWeight * scale);
  }
}

}  // namespace

std::vector<BoundLine> bound_lines(const StabilityBounds& bounds) {
  std::vector<BoundLine> lines;
  const auto add = [&](const char* label, const std::optional<double>& stiffness_n_per_m) {
    if (!stiffness_n_per_m) return;
    const auto equal = std::find_if(lines.begin(), lines.end(), [&](const BoundLine& line) {
      return line.stiffness_n_per_m == *stiffness_n_per_m;
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
  std::stable_sort(lines.begin(), lines.end(), [](const BoundLine& a, const BoundLine& b) {
    return a.stiffness_n_per_m < b.stiffness_n_per_m;
  });
  return lines;
}

void draw_bounds(const Theme& theme, const std::vector<BoundLine>& bounds, double scale) {
  const ImPlotRect limits = ImPlot::GetPlotLimits();
  ImDrawList* list = ImPlot::GetPlotDrawList();
  const float font_scale = ImGui::GetStyle().FontScaleMain;
  const ImVec2 corner = ImPlot::GetPlotPos();
  const float right = corner.x + ImPlot::GetPlotSize().x;
  const float gap = 0.3F * ImGui::GetFontSize();
  // Labels of bounds closer than a line of text go beside each other.
  float label_right = right;
  float last_y = std::numeric_limits<float>::infinity();
  ImPlot::PushPlotClipRect();
  for (const BoundLine& bound : bounds) {
    const double value = bound.stiffness_n_per_m * scale;
    if (!limits.Y.Contains(value)) continue;
    const float y = ImPlot::PlotToPixels(limits.X.Min, value).y;
    draw_dashes(list, ImVec2(corner.x, y), right, theme.packed(Tone::kText, 0.8F), font_scale);
    const ImVec2 size = ImGui::CalcTextSize(bound.label.c_str());
    const float height = size.y + gap;
    label_right = (last_y - y < height ? label_right : right) - size.x - 2.0F * gap;
    last_y = y;
    const ImVec2 label(label_right, y - height > corner.y ? y - height : y + gap);
    list->AddRectFilled(ImVec2(label.x - gap, label.y),
                        ImVec2(label.x + size.x + gap, label.y + size.y),
                        theme.packed(Tone::kBackground, 0.75F), gap);
    list->AddText(label, theme.packed(Tone::kText, 0.9F), bound.label.c_str());
  }
  ImPlot::PopPlotClipRect();
}

}  // namespace hapticwall::draw
