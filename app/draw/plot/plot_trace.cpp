#include "app/draw/plot/plot_trace.h"

#include <algorithm>

namespace hapticwall::draw {
namespace {

PixelScale pixel_scale(double first, double second, float first_pixel, float second_pixel) {
  PixelScale result;
  result.scale = static_cast<double>(second_pixel - first_pixel) / (second - first);
  result.origin = static_cast<double>(first_pixel) - result.scale * first;
  return result;
}

}  // namespace

void draw_trace(const Trace& trace, const TraceStyle& style, ImAxis value_axis,
                std::vector<PixelColumn>& columns) {
  const ImPlotRect limits = ImPlot::GetPlotLimits(ImAxis_X1, value_axis);
  const ImVec2 corner = ImPlot::GetPlotPos();
  const ImVec2 size = ImPlot::GetPlotSize();
  const PixelScale x = pixel_scale(limits.X.Min, limits.X.Max, corner.x, corner.x + size.x);
  const PixelScale y = pixel_scale(limits.Y.Max, limits.Y.Min, corner.y, corner.y + size.y);
  if (is_band(trace, x, y)) {
    band_of(trace, x, y, columns);
    ImPlot::PushPlotClipRect();
    draw_band(ImPlot::GetPlotDrawList(), columns, ImGui::ColorConvertFloat4ToU32(style.colour),
              style.weight);
    ImPlot::PopPlotClipRect();
    return;
  }
  ImPlotSpec spec;
  spec.LineColor = style.colour;
  spec.LineWeight = style.weight;
  spec.Flags = ImPlotItemFlags_NoLegend | ImPlotItemFlags_NoFit;
  ImPlot::SetAxes(ImAxis_X1, value_axis);
  ImPlot::PlotLine(style.name, trace.time_s.data(), trace.value.data(),
                   static_cast<int>(trace.time_s.size()), spec);
}

std::size_t plot_columns() {
  return static_cast<std::size_t>(std::max(2.0F, ImPlot::GetPlotSize().x));
}

}  // namespace hapticwall::draw
