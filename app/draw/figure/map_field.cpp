#include "app/draw/figure/map_field.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "app/draw/axis/axis_titles.h"
#include "app/draw/axis/ticks.h"
#include "app/draw/figure/column_name.h"
#include "app/draw/figure/verdict_colours.h"
#include "app/draw/plot/log_plot.h"
#include "app/draw/plot/plot_axes.h"
#include "app/file/text/number_name.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::draw {
namespace {

// A place on the axis, in steps of it, as a value.
double value_at(const MapAxis& axis, double steps) {
  const double part = steps / static_cast<double>(axis.count - 1);
  return axis.logarithmic ? axis.low * std::pow(axis.high / axis.low, part)
                          : axis.low + part * (axis.high - axis.low);
}

ImVec2 pixels_of(const StabilityMap& map, double x, double y) {
  return ImPlot::PlotToPixels(value_at(map.x, x), value_at(map.y, y));
}

// Neighbours in x of one colour become one rectangle. It reaches under those drawn later, so that
// no gap shows between them in a vector file.
void draw_cells(const StabilityMap& map, std::span<const MapMetrics> figures) {
  constexpr double kHalf = 0.5;
  constexpr float kUnder = 1.0F;  // pixels
  ImDrawList& list = *ImPlot::GetPlotDrawList();
  for (std::size_t y = 0; y < map.y.count; ++y) {
    const std::size_t row = y * map.x.count;
    for (std::size_t from = 0; from < map.x.count;) {
      const ImU32 colour = colour_of(figures[row + from]);
      std::size_t to = from + 1;
      while (to < map.x.count && colour_of(figures[row + to]) == colour) ++to;
      const auto foot = static_cast<double>(y) - kHalf;
      const ImVec2 head = pixels_of(map, static_cast<double>(from) - kHalf, foot + 1.0);
      const ImVec2 end = pixels_of(map, static_cast<double>(to) - kHalf, foot);
      list.AddRectFilled({head.x, head.y - kUnder}, {end.x + kUnder, end.y}, colour);
      from = to;
    }
  }
}

void draw_bounds(const StabilityMap& map, std::span<const BoundLines> bounds, float scale) {
  ImDrawList& list = *ImPlot::GetPlotDrawList();
  for (const BoundLines& bound : bounds) {
    for (const BoundSegment& line : bound.lines) {
      list.AddLine(pixels_of(map, line.from.x, line.from.y), pixels_of(map, line.to.x, line.to.y),
                   bound_styles()[bound.bound].colour, bound_styles()[bound.bound].weight * scale);
    }
  }
}

// Every second one until the labels have room.
std::vector<AxisTick> thinned(std::vector<AxisTick> ticks, float length,
                              const std::function<double(double)>& scale, bool across) {
  const auto fits = [&] {
    return across ? have_room_across(ticks, length, scale)
                  : static_cast<int>(ticks.size()) <= max_ticks_up(length);
  };
  while (ticks.size() > 2 && !fits()) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ticks.size(); i += 2) ticks[kept++] = ticks[i];
    ticks.resize(kept);
  }
  return ticks;
}

// Ticks in the shown unit, at their SI values.
std::vector<AxisTick> map_ticks(const MapAxis& axis, float length, bool across) {
  constexpr double kHalf = 0.5;
  const double unit = file::number_name(axis.number).scale;
  const double low = value_at(axis, -kHalf) * unit;
  const double high = value_at(axis, static_cast<double>(axis.count) - kHalf) * unit;
  std::vector<AxisTick> ticks;
  if (axis.logarithmic) {
    const Decades decades{std::log10(low), std::log10(high), 0.0};
    for (const AxisNumber& number : axis_numbers(decades))
      ticks.push_back({number.value, number.text});
    const auto scale = [&](double value) {
      return (std::log10(value) - decades.from) / (decades.to - decades.from);
    };
    ticks = thinned(std::move(ticks), length, scale, across);
  } else {
    ticks = across ? ticks_across(low, high, length) : round_ticks(low, high, max_ticks_up(length));
  }
  for (AxisTick& tick : ticks) tick.value /= unit;
  return ticks;
}

void set_up_axis(ImAxis id, const MapAxis& axis, float length, bool labels) {
  constexpr double kHalf = 0.5;
  ImPlot::SetupAxis(
      id, nullptr,
      kAxisFlags | ImPlotAxisFlags_NoGridLines | (labels ? 0 : ImPlotAxisFlags_NoTickLabels));
  if (axis.logarithmic) ImPlot::SetupAxisScale(id, ImPlotScale_Log10);
  ImPlot::SetupAxisLimits(id, value_at(axis, -kHalf),
                          value_at(axis, static_cast<double>(axis.count) - kHalf),
                          ImPlotCond_Always);
  set_up_ticks(id, map_ticks(axis, length, id == ImAxis_X1));
}

std::string label_of(const StabilityMap& map, std::size_t algorithm) {
  AlgorithmSettings settings = map.scene.algorithm;
  settings.index = map.algorithms[algorithm];
  return algorithm_label(settings);
}

std::span<const MapMetrics> cells_of(const MapContents& contents, std::size_t algorithm) {
  const std::size_t cells = contents.map.x.count * contents.map.y.count;
  return contents.figures.subspan(algorithm * cells, cells);
}

// The label of the algorithm and its share of good cells; on screen in one line if it has room.
void draw_field_heading(const Theme& theme, const MapContents& contents, std::size_t algorithm,
                        float width) {
  const std::span<const MapMetrics> figures = cells_of(contents, algorithm);
  const auto good = std::ranges::count_if(figures, is_good, &MapMetrics::verdict);
  const std::string label = label_of(contents.map, algorithm);
  const std::string share =
      fmt::format("{:.1f} % settled or moving",
                  100.0 * static_cast<double>(good) / static_cast<double>(figures.size()));
  draw_column_name(theme, label, width);
  const float used = ImGui::GetItemRectSize().x + ImGui::GetStyle().ItemSpacing.x;
  const FontScope font(nullptr, kSmallFontSize);
  if (!theme.prints() && used + ImGui::CalcTextSize(share.c_str()).x <= width) ImGui::SameLine();
  ImGui::TextDisabled("%s", share.c_str());
}

// Fields in a row of the window.
std::size_t columns_for(std::size_t fields) {
  constexpr std::size_t kMaxInOneRow = 3;
  return fields <= kMaxInOneRow ? fields : (fields + 1) / 2;
}

}  // namespace

ImU32 colour_of(const MapMetrics& figures) {
  if (figures.verdict != Verdict::kOscillating) return verdict_area(figures.verdict);
  return oscillating_colour(figures.tail_peak_to_peak_m.value_or(kHottestM));
}

std::string map_axis_title(const MapAxis& axis) { return file::number_name(axis.number).title(); }

MapFieldArea draw_map_field(const Theme& theme, const MapContents& contents, std::size_t algorithm,
                            const MapFieldFrame& frame) {
  MapFieldArea area;
  const StabilityMap& map = contents.map;
  const float top = ImGui::GetCursorScreenPos().y;
  ImGui::BeginGroup();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + frame.labels);
  ImGui::BeginGroup();
  draw_field_heading(theme, contents, algorithm, frame.size.x - frame.labels);
  ImGui::EndGroup();
  const float below = frame.titles ? 1.2F * ImGui::GetFontSize() : 0.0F;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float left = frame.titles ? title_room("", 0.0F) : 0.0F;
  const ImVec2 size(frame.size.x - left, frame.size.y - (corner.y - top) - below);
  ImGui::SetCursorScreenPos({corner.x + left, corner.y});
  ImGui::PushFont(theme.fonts.digits, kSmallFontSize);
  if (ImPlot::BeginPlot(fmt::format("##map{}", algorithm).c_str(), size, plot_flags(false))) {
    set_up_axis(ImAxis_X1, map.x, size.x - frame.labels, true);
    set_up_axis(ImAxis_Y1, map.y, size.y - ems(2.0F), frame.value_labels);
    ImPlot::PushPlotClipRect();
    draw_cells(map, cells_of(contents, algorithm));
    draw_bounds(map, contents.bounds, contents.scale);
    ImPlot::PopPlotClipRect();
    area = {ImPlot::GetPlotPos(), ImPlot::GetPlotSize()};
    ImPlot::EndPlot();
  }
  ImGui::PopFont();
  if (frame.titles) {
    const ImU32 colour = theme.packed(Tone::kMuted);
    draw_upright_title(colour, map_axis_title(map.y), corner.x, left, area.corner.y, area.size.y);
    ImGui::SetCursorScreenPos({corner.x, corner.y + size.y});
    draw_title_below(colour, map_axis_title(map.x), area.corner.x, area.size.x);
  }
  ImGui::EndGroup();
  return area;
}

void draw_map_fields(const Theme& theme, const MapContents& contents, const OverMapField& over) {
  const std::size_t fields = contents.map.algorithms.size();
  const std::size_t columns = columns_for(fields);
  const std::size_t rows = (fields + columns - 1) / columns;
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const float gap = ImGui::GetFontSize();
  const ImVec2 each((free.x - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns),
                    free.y / static_cast<float>(rows) - gap);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  for (std::size_t i = 0; i < fields; ++i) {
    const auto row = static_cast<float>(i / columns);
    const auto column = static_cast<float>(i % columns);
    ImGui::SetCursorScreenPos(
        ImVec2(corner.x + column * (each.x + gap), corner.y + row * (each.y + gap)));
    const MapFieldArea area = draw_map_field(theme, contents, i, {.size = each});
    if (over) over(i, area);
  }
}

}  // namespace hapticwall::draw
