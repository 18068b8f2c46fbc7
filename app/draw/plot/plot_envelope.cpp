#include "app/draw/plot/plot_envelope.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "app/draw/plot/plot_axes.h"

namespace hapticwall::draw {
namespace {

// From so many pixels up and down per pixel to the right a line is drawn as a band.
constexpr double kBandTravel = 3.0;
constexpr std::size_t kMinPoints = 16;
// Clamps far points just outside the screen, within the range of pixel numbers.
constexpr double kFarPixels = 1e5;

double near_screen(double pixel) { return std::clamp(pixel, -kFarPixels, kFarPixels); }

PixelScale pixel_scale(double first, double second, float first_pixel, float second_pixel) {
  PixelScale result;
  result.scale = static_cast<double>(second_pixel - first_pixel) / (second - first);
  result.origin = static_cast<double>(first_pixel) - result.scale * first;
  return result;
}

}  // namespace

bool is_band(const Trace& trace, const PixelScale& x, const PixelScale& y) {
  if (trace.value.size() < kMinPoints) return false;
  const double width = std::abs(x(trace.time_s.back()) - x(trace.time_s.front()));
  if (width > static_cast<double>(trace.value.size())) return false;  // enough room for strokes
  double travel = 0.0;
  for (std::size_t i = 1; i < trace.value.size(); ++i)
    travel += std::abs(trace.value[i] - trace.value[i - 1]);
  return travel * std::abs(y.scale) > kBandTravel * width;
}

void band_of(const Trace& trace, const PixelScale& x, const PixelScale& y,
             std::vector<PixelColumn>& columns) {
  columns.clear();
  for (std::size_t i = 0; i < trace.value.size(); ++i) {
    const int column = static_cast<int>(std::floor(near_screen(x(trace.time_s[i]))));
    const double pixel = near_screen(y(trace.value[i]));
    if (columns.empty() || columns.back().x != column) columns.push_back({column, pixel, pixel});
    columns.back().top = std::min(columns.back().top, pixel);
    columns.back().bottom = std::max(columns.back().bottom, pixel);
  }
  // The gap between two columns without common rows belongs to the later one.
  std::pair<double, double> before;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    PixelColumn& column = columns[i];
    const std::pair<double, double> own{column.top, column.bottom};
    if (i > 0) {
      column.top = std::min(column.top, before.second);
      column.bottom = std::max(column.bottom, before.first);
    }
    before = own;
  }
}

void draw_band(ImDrawList* list, const std::vector<PixelColumn>& columns, ImU32 colour,
               float weight) {
  if (columns.empty()) return;
  const auto count = static_cast<int>(columns.size());
  list->PrimReserve(6 * count, 4 * count);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const PixelColumn& column = columns[i];
    // Up to the next column; with missing samples that is farther than one pixel.
    const int right = i + 1 < columns.size() ? columns[i + 1].x : column.x + 1;
    list->PrimRect(
        ImVec2(static_cast<float>(column.x), static_cast<float>(column.top) - 0.5F * weight),
        ImVec2(static_cast<float>(right), static_cast<float>(column.bottom) + 0.5F * weight),
        colour);
  }
}

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
  ImPlotSpec spec = line_spec(style.colour);
  spec.LineWeight = style.weight;
  ImPlot::SetAxes(ImAxis_X1, value_axis);
  ImPlot::PlotLine(style.name, trace.time_s.data(), trace.value.data(),
                   static_cast<int>(trace.time_s.size()), spec);
}

std::size_t plot_columns() {
  return static_cast<std::size_t>(std::max(2.0F, ImPlot::GetPlotSize().x));
}

}  // namespace hapticwall::draw
