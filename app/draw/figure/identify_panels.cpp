// The panels of an identification as plots: aligned, with their legends above, and the distribution
// of the residual beside it.
#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/draw/axis/axis_titles.h"
#include "app/draw/axis/ticks.h"
#include "app/draw/figure/identify_figure.h"
#include "app/draw/plot/plot_axes.h"

namespace hapticwall::draw {
namespace {

constexpr float kHistogramShare = 0.2F;  // of the width
constexpr float kOuterShare = 0.3F;      // of the colour: smallest to largest value
constexpr float kInnerShare = 0.7F;      // 5 % to 95 %
constexpr float kCurveWeight = 1.2F;     // pixels at scale 1

struct PanelRange {
  double begin = 0.0;
  double end = 1.0;
  double low = 0.0;
  double high = 1.0;

  void include(double x, double y) {
    begin = std::min(begin, x);
    end = std::max(end, x);
    low = std::min(low, y);
    high = std::max(high, y);
  }
};

// The range of everything that the panel shows, with room above and below.
PanelRange range_of(const FigurePanel& panel) {
  constexpr double kPanelRoom = 0.08;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  PanelRange range{kFar, -kFar, kFar, -kFar};
  for (const FigureCurve& curve : panel.curves) {
    for (std::size_t i = 0; i < curve.x.size(); ++i) range.include(curve.x[i], curve.y[i]);
  }
  for (const SpreadPart& part : panel.spread.parts) {
    range.include(part.x, part.values.front());
    range.include(part.x, part.values.back());
  }
  if (!(range.begin < range.end)) return {};
  const double room = std::max(kPanelRoom * (range.high - range.low), 1e-9);
  return {range.begin, range.end, range.low - room, range.high + room};
}

void draw_curves(const Theme& theme, const FigurePanel& panel) {
  for (const FigureCurve& curve : panel.curves) {
    ImPlotSpec spec = line_spec(theme.colour(curve.tone));
    spec.LineWeight = kCurveWeight * ImGui::GetStyle().FontScaleMain;
    ImPlot::PlotLine(curve.name.c_str(), curve.x.data(), curve.y.data(),
                     static_cast<int>(curve.x.size()), spec);
  }
}

// Mixed, not transparent: seams of overlapping parts stay invisible.
ImU32 band_colour(const Theme& theme, float share) {
  return ImGui::ColorConvertFloat4ToU32(
      mixed(theme.colour(Tone::kBackground), theme.colour(Tone::kPosition), share));
}

// The bands of the spread, one inside the other.
void draw_bands(const Theme& theme, const Spread& spread) {
  ImDrawList& list = *ImPlot::GetPlotDrawList();
  ImPlot::PushPlotClipRect();
  for (std::size_t i = 0; i + 1 < spread.parts.size(); ++i) {
    const SpreadPart& part = spread.parts[i];
    const auto fill = [&](double low, double high, float share) {
      const ImVec2 from = ImPlot::PlotToPixels(part.x, high);
      const ImVec2 to = ImPlot::PlotToPixels(spread.parts[i + 1].x, low);
      // Under the next part, so that no gap shows.
      list.AddRectFilled(from, {to.x + 1.0F, to.y}, band_colour(theme, share));
    };
    fill(part.values[0], part.values[3], kOuterShare);
    fill(part.values[1], part.values[2], kInnerShare);
  }
  ImPlot::PopPlotClipRect();
}

struct LegendPart {
  std::string text;
  ImU32 colour;
  bool line;  // else an area
};

std::vector<LegendPart> legend_of(const Theme& theme, const FigurePanel& panel) {
  std::vector<LegendPart> parts;
  for (const FigureCurve& curve : panel.curves)
    parts.push_back({curve.name, theme.packed(curve.tone), true});
  if (panel.spread.parts.empty()) return parts;
  parts.push_back({"5 to 95 %", band_colour(theme, kInnerShare), false});
  parts.push_back({"all", band_colour(theme, kOuterShare), false});
  return parts;
}

// One line above the panel.
void draw_panel_legend(const Theme& theme, const FigurePanel& panel, ImVec2 corner) {
  const FontScope font(nullptr, kSmallFontSize);
  float left = corner.x;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize();
  for (const LegendPart& part : legend_of(theme, panel)) {
    const float middle = corner.y + 0.6F * em;
    if (part.line) {
      list.AddLine({left, middle}, {left + 1.2F * em, middle}, part.colour, 0.14F * em);
    } else {
      list.AddRectFilled({left, middle - 0.35F * em}, {left + 1.2F * em, middle + 0.35F * em},
                         part.colour);
    }
    list.AddText({left + 1.6F * em, corner.y}, theme.packed(Tone::kText), part.text.c_str());
    left += 3.0F * em + ImGui::CalcTextSize(part.text.c_str()).x;
  }
}

void set_up(const PanelRange& range, ImVec2 size, bool time_labels) {
  ImPlot::SetupAxis(ImAxis_X1, nullptr,
                    kAxisFlags | (time_labels ? 0 : ImPlotAxisFlags_NoTickLabels));
  ImPlot::SetupAxis(ImAxis_Y1, nullptr, kAxisFlags);
  ImPlot::SetupAxesLimits(range.begin, range.end, range.low, range.high, ImPlotCond_Always);
  set_up_ticks(ImAxis_X1, ticks_across(range.begin, range.end, size.x - ems(3.0F)));
  set_up_ticks(ImAxis_Y1, round_ticks(range.low, range.high, max_ticks_up(size.y - ems(2.0F))));
  ImPlot::SetupFinish();
}

struct PanelArea {
  ImVec2 corner;
  ImVec2 size;
};

PanelArea draw_panel_plot(const Theme& theme, const FigurePanel& panel, const PanelRange& range,
                          ImVec2 size, bool time_labels) {
  const FontScope font(nullptr, kSmallFontSize);
  const std::string id = "##" + panel.title;
  if (!ImPlot::BeginPlot(id.c_str(), size, plot_flags(false))) return {};
  set_up(range, size, time_labels);
  draw_curves(theme, panel);
  draw_bands(theme, panel.spread);
  const PanelArea area{ImPlot::GetPlotPos(), ImPlot::GetPlotSize()};
  ImPlot::EndPlot();
  return area;
}

// Bars that begin at the left and have the height of their bins in the panel beside them.
void draw_histogram(const Theme& theme, const Spread& spread, const PanelRange& range,
                    const PanelArea& area) {
  const FontScope font(nullptr, kSmallFontSize);
  const double highest = std::ranges::max(spread.bins, {}, &Bin::share).share;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto y_of = [&](double value) {
    const double share = (range.high - value) / (range.high - range.low);
    return area.corner.y + static_cast<float>(share) * area.size.y;
  };
  for (const Bin& bin : spread.bins) {
    const float length = static_cast<float>(bin.share / highest) * area.size.x;
    list.AddRectFilled({area.corner.x, y_of(bin.high)}, {area.corner.x + length, y_of(bin.low)},
                       band_colour(theme, kInnerShare));
  }
  const ImVec2 foot(area.corner.x, area.corner.y + area.size.y);
  list.AddLine({foot.x, area.corner.y}, foot, theme.packed(Tone::kMuted), ems(0.06F));
  const std::string most = fmt::format("{:.0f} %", 100.0 * highest);
  const float width = ImGui::CalcTextSize(most.c_str()).x;
  const float below = foot.y + ems(0.3F);
  list.AddText({foot.x, below}, theme.packed(Tone::kMuted), "0");
  list.AddText({foot.x + area.size.x - width, below}, theme.packed(Tone::kMuted), most.c_str());
}

// The panel within `size`: legend, plot with the titles of its axes, distribution.
void draw_panel(const Theme& theme, const FigurePanel& panel, float room, bool time_title,
                ImVec2 size) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const PanelRange range = range_of(panel);
  const float line = 1.2F * ImGui::GetFontSize();
  const bool spreads = !panel.spread.bins.empty();
  const float beside = spreads ? kHistogramShare * size.x : 0.0F;
  const float top = corner.y + line;
  const float below = time_title ? line : 0.0F;
  ImGui::SetCursorScreenPos({corner.x + room, top});
  const ImVec2 plot(size.x - room - beside - 0.7F * line, size.y - (top - corner.y) - below);
  const PanelArea area = draw_panel_plot(theme, panel, range, plot, time_title);
  const ImU32 colour = theme.packed(Tone::kText);
  draw_panel_legend(theme, panel, {area.corner.x, corner.y});
  draw_upright_title(colour, panel.title, corner.x, room, area.corner.y, area.size.y);
  if (spreads) {
    const float left = area.corner.x + area.size.x + line;
    draw_histogram(theme, panel.spread, range,
                   {{left, area.corner.y}, {beside - 1.4F * line, area.size.y}});
    ImGui::SetCursorScreenPos({corner.x, corner.y + size.y - below});
    draw_title_below(colour, "share", left, beside - 1.4F * line);
  }
  ImGui::SetCursorScreenPos({corner.x, corner.y + size.y - below});
  if (time_title) draw_title_below(colour, "time t (s)", area.corner.x, area.size.x);
  ImGui::SetCursorScreenPos({corner.x, corner.y + size.y});
}

// Panels over the same time share the time axis of the last one.
bool has_time_axis(std::span<const FigurePanel> panels, std::size_t i) {
  if (i + 1 == panels.size()) return true;
  const PanelRange own = range_of(panels[i]);
  const PanelRange next = range_of(panels[i + 1]);
  return own.begin != next.begin || own.end != next.end;
}

}  // namespace

void draw_panels(const Theme& theme, std::span<const FigurePanel> panels, ImVec2 size) {
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  const auto count = static_cast<float>(panels.size());
  const ImVec2 each(size.x, (size.y - (count - 1.0F) * gap) / count);
  float room = 0.0F;
  for (const FigurePanel& panel : panels)
    room = std::max(room, title_room(panel.title, 0.7F * each.y));
  ImPlot::BeginAlignedPlots("panels");  // gives all panels one left margin
  for (std::size_t i = 0; i < panels.size(); ++i) {
    draw_panel(theme, panels[i], room, has_time_axis(panels, i), each);
    const ImVec2 below = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({below.x, below.y + gap});
  }
  ImGui::Dummy(ImVec2());  // a moved cursor alone extends no window
  ImPlot::EndAlignedPlots();
}

}  // namespace hapticwall::draw
