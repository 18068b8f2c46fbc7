#include "app/draw/plot/plot_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/draw/axis/ticks.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {
namespace {

constexpr float kFaintAlpha = 0.15F;
constexpr float kBoldAlpha = 0.5F;
constexpr double kBoldHeight = 4.0;  // relative to a faint band
// Clamps far points just outside the screen, within the range of pixel numbers.
constexpr double kFarPixels = 1e5;
constexpr double kFarValue = std::numeric_limits<double>::infinity();

// Conversion from the units of an axis to pixels, for ImPlot's linear axes.
struct PixelScale {
  double origin = 0.0;
  double scale = 1.0;

  PixelScale(double first, double second, float first_pixel, float second_pixel)
      : scale(static_cast<double>(second_pixel - first_pixel) / (second - first)) {
    origin = static_cast<double>(first_pixel) - scale * first;
  }
  [[nodiscard]] float operator()(double value) const {
    return static_cast<float>(std::clamp(origin + scale * value, -kFarPixels, kFarPixels));
  }
};

struct PlotPixels {
  PixelScale x;
  PixelScale y;
};

PlotPixels plot_pixels(ImAxis value_axis) {
  const ImPlotRect limits = ImPlot::GetPlotLimits(ImAxis_X1, value_axis);
  const ImVec2 corner = ImPlot::GetPlotPos();
  const ImVec2 size = ImPlot::GetPlotSize();
  return {{limits.X.Min, limits.X.Max, corner.x, corner.x + size.x},
          {limits.Y.Max, limits.Y.Min, corner.y, corner.y + size.y}};
}

// The columns that the range takes.
std::size_t columns_of(const TraceSource& source, const PlotPixels& pixels, float column) {
  const auto time_s = [&](std::size_t i) { return source.history.value(&Sample::time_s, i); };
  const double length_s = time_s(source.range.last - 1) - time_s(source.range.first);
  return static_cast<std::size_t>(
      std::max(std::round(length_s * pixels.x.scale / static_cast<double>(column)), 2.0));
}

void place(const TraceSource& source, SignalShape& shape) {
  const Extremes clip = source.clip.value_or(Extremes{-kFarValue, kFarValue});
  const auto placed = [&](double value) {
    const double clipped =
        std::clamp(value, clip.minimum * source.scale, clip.maximum * source.scale);
    return source.knee > 0.0 ? to_symlog(clipped, source.knee) : clipped;
  };
  for (double& time_s : shape.line.time_s) time_s += source.shift_s;
  for (double& value : shape.line.value) value = placed(value);
  for (BandColumn& column : shape.band)
    column = {column.time_s + source.shift_s, placed(column.low), placed(column.high)};
}

// Columns with the same rows become one box, because narrow boxes are slow in a software renderer.
void draw_band(const std::vector<BandColumn>& band, const TraceStyle& style,
               const PlotPixels& pixels, PlotInk& ink) {
  if (band.empty() || style.band_strength == 0.0F) return;
  PixelBox box;
  ImU32 colour = 0;
  const auto paint = [&] {
    ImPlot::GetPlotDrawList()->AddRectFilled(box.from, box.to, colour);
    ink.take(box);
  };
  for (std::size_t i = 0; i < band.size(); ++i) {
    const float left = pixels.x(band[i].time_s);
    // Up to the next column, unless that is on the other side of a gap.
    const float next = i + 1 < band.size() ? pixels.x(band[i + 1].time_s) : left + style.column;
    const PixelBox column{{left, std::round(pixels.y(band[i].high))},
                          {next - left < 2.0F * style.column ? next : left + style.column,
                           std::round(pixels.y(band[i].low))}};
    if (i > 0 && column.from.x == box.to.x && column.from.y == box.from.y &&
        column.to.y == box.to.y) {
      box.to.x = column.to.x;
      continue;
    }
    if (i > 0) paint();
    box = column;
    const float alpha = band_alpha(band[i].high - band[i].low, style.faint_height);
    colour = ImGui::ColorConvertFloat4ToU32(
        with_alpha(style.colour, style.colour.w * alpha * style.band_strength));
  }
  paint();
}

void note_end(const TraceStyle& style, PlotScratch& scratch) {
  const auto is_point = [](const ImVec2& point) { return !std::isnan(point.y); };
  const auto last = std::find_if(scratch.points.rbegin(), scratch.points.rend(), is_point);
  if (style.label == nullptr || last == scratch.points.rend()) return;
  scratch.ink.ends.push_back({style.label, ImGui::ColorConvertFloat4ToU32(style.colour), *last});
}

}  // namespace

float band_alpha(double height, double faint_height) {
  const double times = height / faint_height;
  const auto share = static_cast<float>(std::clamp((times - 1.0) / (kBoldHeight - 1.0), 0.0, 1.0));
  return kFaintAlpha + share * (kBoldAlpha - kFaintAlpha);
}

void draw_trace(const TraceSource& source, const TraceStyle& style, ImAxis value_axis,
                PlotScratch& scratch) {
  const PlotPixels pixels = plot_pixels(value_axis);
  SignalShape& shape = scratch.shape;
  shape_signal(source.history, source.quantity, source.range,
               columns_of(source, pixels, style.column), source.scale, shape);
  place(source, shape);
  scratch.points.clear();
  for (std::size_t i = 0; i < shape.line.value.size(); ++i)
    scratch.points.emplace_back(pixels.x(shape.line.time_s[i]), pixels.y(shape.line.value[i]));
  scratch.ink.take(scratch.points, style.weight);
  ImPlot::SetAxes(ImAxis_X1, value_axis);
  ImPlot::PushPlotClipRect();
  draw_band(shape.band, style, pixels, scratch.ink);
  note_end(style, scratch);
  keep_bends(scratch.points);
  draw_dashed(ImPlot::GetPlotDrawList(), scratch.points,
              ImGui::ColorConvertFloat4ToU32(style.colour), style.weight, style.dash,
              ImGui::GetStyle().FontScaleMain);
  ImPlot::PopPlotClipRect();
}

}  // namespace hapticwall::draw
