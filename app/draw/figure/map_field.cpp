#include "app/draw/figure/map_field.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/algorithm/algorithm.h"
#include "core/run/metrics.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr float kMapLineWeight = 2.0F;
constexpr float kThinLineWeight = 0.8F;
constexpr float kBelowPlotEms = 4.0F;  // labels and title of the axis across

constexpr ImU32 kSettled = IM_COL32(203, 226, 222, 255);
constexpr ImU32 kUntouched = IM_COL32(208, 208, 208, 255);
constexpr ImU32 kActive = IM_COL32(140, 190, 235, 255);
constexpr ImU32 kBuzzing = IM_COL32(176, 160, 214, 255);
constexpr ImU32 kDiverged = IM_COL32(52, 42, 48, 255);
// Colours from the smallest oscillation to the largest.
constexpr std::array<ImVec4, 4> kHot{{{0.99F, 0.88F, 0.55F, 1.0F},
                                      {0.96F, 0.62F, 0.28F, 1.0F},
                                      {0.83F, 0.29F, 0.22F, 1.0F},
                                      {0.46F, 0.09F, 0.24F, 1.0F}}};
// Neighbours of nearly the same amplitude share a colour, so that they are drawn as one.
constexpr double kColourSteps = 48.0;

// A bound of theory, or what CHAI3D allows, as it is drawn.
struct BoundStyle {
  const char* name;
  BoundMember bound;  // nullptr: of CHAI3D
  ImU32 colour;
  float weight = kMapLineWeight;
};
constexpr std::array<BoundStyle, 6> kBounds{
    {{"K = 2 (b - B) / T, passive", &StabilityBounds::passive_n_per_m, IM_COL32(20, 60, 140, 255)},
     {"stable below, with this hand", &StabilityBounds::stable_n_per_m,
      IM_COL32(120, 40, 150, 255)},
     {"K = (b + B) / (T/2 + t_d), rule for B T/m < 0.1 without a hand",
      &StabilityBounds::rule_n_per_m, IM_COL32(165, 90, 190, 255), kThinLineWeight},
     {"K = 2 f_c / Δ", &StabilityBounds::friction_n_per_m, IM_COL32(0, 120, 90, 255)},
     {"K = F_max / Δ", &StabilityBounds::resolution_n_per_m, IM_COL32(60, 60, 60, 255)},
     {"largest K and B that CHAI3D allows on this device", nullptr, IM_COL32(0, 110, 255, 255)}}};

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
                   kBounds.at(bound.bound).colour, kBounds.at(bound.bound).weight * scale);
    }
  }
}

// Key and unit of an axis, with the dimensionless range if it fits; else the unit alone.
std::string axis_title(const Scene& scene, const MapAxis& axis, const MapAxis& other, float room) {
  const auto fits = [&](const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x <= room;
  };
  std::string title = axis.number.path;
  if (!axis.number.unit.empty()) title += ", " + axis.number.unit;
  if (!fits(title)) return axis.number.unit;
  if (const auto number = dimensionless(scene, axis, other)) {
    std::string whole = fmt::format("{}   ({}: {:.3g} to {:.3g})", title, number->symbol,
                                    axis.low * number->factor, axis.high * number->factor);
    if (fits(whole)) return whole;
  }
  return title;
}

void set_up_axis(ImAxis id, const MapAxis& axis, const std::string& title) {
  constexpr double kHalf = 0.5;
  ImPlot::SetupAxis(id, title.c_str(), ImPlotAxisFlags_NoGridLines);
  if (axis.logarithmic) ImPlot::SetupAxisScale(id, ImPlotScale_Log10);
  ImPlot::SetupAxisFormat(id, "%g");
  ImPlot::SetupAxisLimits(id, value_at(axis, -kHalf),
                          value_at(axis, static_cast<double>(axis.count) - kHalf),
                          ImPlotCond_Always);
}

std::string label_of(const StabilityMap& map, std::size_t algorithm) {
  AlgorithmSettings settings = map.scene.algorithm;
  settings.index = map.algorithms[algorithm];
  return algorithm_label(settings);
}

MapFieldArea draw_field(const Theme& theme, const MapContents& contents, std::size_t algorithm,
                        ImVec2 size) {
  MapFieldArea area;
  const StabilityMap& map = contents.map;
  const std::size_t cells = map.x.count * map.y.count;
  const std::span<const MapMetrics> figures = contents.figures.subspan(algorithm * cells, cells);
  const auto good = std::ranges::count_if(figures, is_good, &MapMetrics::verdict);
  ImGui::BeginGroup();
  ImGui::PushFont(theme.fonts.strong, kFontSize);
  ImGui::TextUnformatted(label_of(map, algorithm).c_str());
  ImGui::PopFont();
  ImGui::SameLine();
  ImGui::PushFont(nullptr, kSmallFontSize);
  ImGui::TextDisabled("%.1f %% settled or moving",
                      100.0 * static_cast<double>(good) / static_cast<double>(cells));
  const float height = size.y - ImGui::GetTextLineHeightWithSpacing() - ImGui::GetFontSize();
  const std::string name = fmt::format("##map{}", algorithm);
  if (ImPlot::BeginPlot(name.c_str(), ImVec2(size.x, height),
                        ImPlotFlags_CanvasOnly | ImPlotFlags_NoInputs)) {
    set_up_axis(ImAxis_X1, map.x, axis_title(map.scene, map.x, map.y, size.x));
    set_up_axis(ImAxis_Y1, map.y, axis_title(map.scene, map.y, map.x, height - ems(kBelowPlotEms)));
    ImPlot::PushPlotClipRect();
    draw_cells(map, figures);
    draw_bounds(map, contents.bounds, contents.scale);
    ImPlot::PopPlotClipRect();
    area = {ImPlot::GetPlotPos(), ImPlot::GetPlotSize()};
    ImPlot::EndPlot();
  }
  ImGui::PopFont();
  ImGui::EndGroup();
  return area;
}

// Starts a new line if the key does not fit beside the previous one.
void begin_key(float width) {
  const bool first = ImGui::GetCursorPosX() <= ImGui::GetCursorStartPos().x;
  if (!first && ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

// A box of a colour, or a line of a weight, and its meaning; the next item stands beside it.
void draw_key(ImU32 colour, const char* text, float line_weight = 0.0F) {
  const float side = ImGui::GetFontSize();
  begin_key(2.0F * side + ImGui::CalcTextSize(text).x);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (line_weight > 0.0F) {
    list.AddLine(ImVec2(at.x, at.y + 0.5F * side), ImVec2(at.x + side, at.y + 0.5F * side), colour,
                 line_weight);
  } else {
    list.AddRectFilled(at, ImVec2(at.x + side, at.y + side), colour);
  }
  ImGui::Dummy(ImVec2(side, side));
  ImGui::SameLine();
  ImGui::PushTextWrapPos();
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::SameLine(0.0F, 1.6F * side);
}

// Fields in a row.
std::size_t columns_for(std::size_t fields) {
  constexpr std::size_t kMaxInOneRow = 3;
  return fields <= kMaxInOneRow ? fields : (fields + 1) / 2;
}

}  // namespace

ImU32 settled_colour() { return kSettled; }
ImU32 untouched_colour() { return kUntouched; }
ImU32 active_colour() { return kActive; }
ImU32 buzzing_colour() { return kBuzzing; }
ImU32 diverged_colour() { return kDiverged; }

ImU32 oscillating_colour(double tail_peak_to_peak_m) {
  const double share = std::log(tail_peak_to_peak_m / kSettledPeakToPeakM) /
                       std::log(kHottestM / kSettledPeakToPeakM);
  const double part = std::round(kColourSteps * std::clamp(share, 0.0, 1.0)) / kColourSteps;
  const double place = part * static_cast<double>(kHot.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kHot.size() - 2);
  return ImGui::ColorConvertFloat4ToU32(mixed(
      kHot.at(below), kHot.at(below + 1), static_cast<float>(place - static_cast<double>(below))));
}

ImU32 colour_of(const MapMetrics& figures) {
  switch (figures.verdict) {
    case Verdict::kSettled:
    case Verdict::kMoving:
      return settled_colour();
    case Verdict::kNoContact:
      return untouched_colour();
    case Verdict::kActive:
      return active_colour();
    case Verdict::kBuzzing:
      return buzzing_colour();
    case Verdict::kDiverged:
      return diverged_colour();
    case Verdict::kOscillating:
      break;
  }
  return oscillating_colour(figures.tail_peak_to_peak_m.value_or(kHottestM));
}

std::vector<BoundLines> map_bounds(const StabilityMap& map) {
  std::vector<BoundLines> all;
  const std::vector<CellBounds> cells = cell_bounds(map);
  for (std::size_t i = 0; i < kBounds.size(); ++i) {
    const BoundMember bound = kBounds.at(i).bound;
    std::vector<BoundSegment> lines =
        bound != nullptr ? bound_lines(map, cells, bound) : chai3d_lines(map, cells);
    // Equal lines are drawn once: without a delay and a damped wall the rule is the first bound.
    const bool drawn =
        std::ranges::any_of(all, [&](const BoundLines& other) { return other.lines == lines; });
    if (!lines.empty() && !drawn) all.push_back({i, std::move(lines)});
  }
  return all;
}

void draw_map_legend(std::span<const BoundLines> bounds, float scale) {
  const FontScope font(nullptr, kSmallFontSize);
  draw_key(settled_colour(), "settled or moving");
  draw_key(untouched_colour(), "no contact");
  const std::string active =
      fmt::format("active: gives more than {:g} mW", kMaxGivenW * kMilliwattsPerWatt);
  draw_key(active_colour(), active.c_str());
  const std::string buzzing = fmt::format("buzzing: still, chatter above {:g} N", kMaxChatterN);
  draw_key(buzzing_colour(), buzzing.c_str());
  constexpr std::array kShownM{kSettledPeakToPeakM, 1e-3, 1e-2, kHottestM};
  for (const double amplitude_m : kShownM) {
    const std::string text = fmt::format("{:g} mm", amplitude_m * kMillimetresPerMetre);
    draw_key(oscillating_colour(amplitude_m), text.c_str());
  }
  draw_key(diverged_colour(), "diverged");
  ImGui::NewLine();
  for (const BoundLines& bound : bounds) {
    const BoundStyle& style = kBounds.at(bound.bound);
    draw_key(style.colour, style.name, style.weight * scale);
  }
  const bool theory = !bounds.empty() && kBounds.at(bounds.front().bound).bound != nullptr;
  const char* note = theory ? "bounds of the bare wall, without an algorithm"
                            : "this map has no theoretical bound";
  begin_key(ImGui::CalcTextSize(note).x);
  ImGui::PushTextWrapPos();
  ImGui::TextDisabled("%s", note);
  ImGui::PopTextWrapPos();
}

void draw_map_fields(const Theme& theme, const MapContents& contents, const OverMapField& over) {
  const std::size_t fields = contents.map.algorithms.size();
  const std::size_t columns = columns_for(fields);
  const std::size_t rows = (fields + columns - 1) / columns;
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const float gap = ImGui::GetFontSize();
  const ImVec2 each((free.x - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns),
                    free.y / static_cast<float>(rows));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  for (std::size_t i = 0; i < fields; ++i) {
    const std::size_t row = i / columns;
    ImGui::SetCursorScreenPos(ImVec2(corner.x + static_cast<float>(i % columns) * (each.x + gap),
                                     corner.y + static_cast<float>(row) * each.y));
    const MapFieldArea area = draw_field(theme, contents, i, each);
    if (over) over(i, area);
  }
}

}  // namespace hapticwall::draw
