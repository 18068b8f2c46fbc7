#include "app/draw/plot/log_plot.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "app/draw/axis/axis_titles.h"
#include "app/draw/axis/legend_keys.h"
#include "app/draw/axis/point_labels.h"
#include "app/draw/axis/symbol_text.h"
#include "app/draw/axis/ticks.h"
#include "app/draw/plot/plot_axes.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {
namespace {

constexpr float kMarkRadius = 4.5F;  // pixels at scale 1
constexpr float kLogLineWeight = 1.4F;
constexpr double kAxisMargin = 0.09;     // beyond the outermost points, of the axis
constexpr double kMinAxisMargin = 0.25;  // decades
constexpr int kMaxDecadeLabels = 9;

// Nullopt if no value is above zero.
std::optional<Decades> decades_of(const LogPlot& plot, double LogPoint::*member) {
  std::optional<Decades> range;
  bool any_zero = false;
  for (const LogSeries& series : plot.series) {
    for (const LogPoint& point : series.points) {
      const double value = point.*member;
      if (!(value > 0.0)) any_zero = true;
      if (!(value > 0.0)) continue;
      const double power = std::log10(value);
      if (!range) range = Decades{power, power, power};
      range->from = std::min(range->from, power);
      range->to = std::max(range->to, power);
    }
  }
  if (!range) return range;
  const double margin = std::max(kAxisMargin * (range->to - range->from), kMinAxisMargin);
  range->zero = range->from - margin;
  range->from -= any_zero ? 2.0 * margin : margin;
  range->to += margin;
  return range;
}

// Numbers of the axis: each of these digits times every power of ten within the range.
std::vector<AxisNumber> numbers_of(const Decades& decades, std::span<const int> digits) {
  std::vector<AxisNumber> numbers;
  const int last = static_cast<int>(std::floor(decades.to));
  for (int exponent = static_cast<int>(std::floor(decades.from)); exponent <= last; ++exponent) {
    for (const int digit : digits) {
      const double power = exponent + std::log10(digit);
      if (power < decades.from || power > decades.to) continue;
      numbers.push_back({std::pow(10.0, power), decimal_text(digit, exponent)});
    }
  }
  return numbers;
}

// Multiples of the step; one of them is 1.
std::vector<AxisNumber> thinned(const Decades& decades) {
  const int first = static_cast<int>(std::ceil(decades.from));
  const int last = static_cast<int>(std::floor(decades.to));
  const int step = (last - first) / kMaxDecadeLabels + 1;
  const int lowest = static_cast<int>(std::ceil(static_cast<double>(first) / step)) * step;
  std::vector<AxisNumber> numbers;
  for (int exponent = lowest; exponent <= last; exponent += step) {
    numbers.push_back({std::pow(10.0, exponent), decimal_text(1, exponent)});
  }
  return numbers;
}

void set_up_axis(ImAxis axis, const Decades& decades) {
  ImPlot::SetupAxis(axis, nullptr, kAxisFlags);
  ImPlot::SetupAxisScale(axis, ImPlotScale_Log10);
  ImPlot::SetupAxisLimits(axis, std::pow(10.0, decades.from), std::pow(10.0, decades.to),
                          ImPlotCond_Always);
  std::vector<AxisTick> ticks;
  for (const AxisNumber& number : axis_numbers(decades))
    ticks.push_back({number.value, number.text});
  set_up_ticks(axis, ticks);
}

ImPlotMarker plot_marker(Mark mark) {
  if (mark == Mark::kCircle) return ImPlotMarker_Circle;
  return mark == Mark::kSquare ? ImPlotMarker_Square : ImPlotMarker_Diamond;
}

// Returns the box of its label.
std::optional<LabelBox> draw_goal(const Theme& theme, const LogPlot& plot) {
  if (!plot.goal) return std::nullopt;
  ImPlotSpec spec = line_spec(with_alpha(theme.colour(Tone::kMuted), 0.7F));
  spec.Flags |= ImPlotInfLinesFlags_Horizontal;
  spec.LineWeight = ImGui::GetStyle().FontScaleMain;
  const double goal = *plot.goal;
  ImPlot::PlotInfLines("##goal", &goal, 1, spec);
  const std::string text = fmt::format("{:g} {}", goal, plot.unit);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 end = ImPlot::PlotToPixels(ImPlot::GetPlotLimits().X.Max, goal);
  const ImVec2 corner(end.x - size.x - 0.5F * size.y, end.y - 1.1F * size.y);
  ImPlot::PushPlotClipRect();
  ImPlot::GetPlotDrawList()->AddText(corner, theme.packed(Tone::kMuted), text.c_str());
  ImPlot::PopPlotClipRect();
  return LabelBox{corner, ImVec2(corner.x + size.x, corner.y + size.y)};
}

void draw_series(const Theme& theme, const LogSeries& series, float scale) {
  std::vector<double> x;
  std::vector<double> y;
  for (const LogPoint& point : series.points) {
    x.push_back(point.x);
    y.push_back(point.y);
  }
  ImPlotSpec line = line_spec(theme.colour(series.tone));
  line.LineWeight = kLogLineWeight * scale;
  ImPlot::PlotLine(series.name.c_str(), x.data(), y.data(), static_cast<int>(x.size()), line);
  for (std::size_t i = 0; i < x.size(); ++i) {
    ImPlotSpec mark = line;
    mark.Marker = plot_marker(series.mark);
    mark.MarkerSize = series.radius * kMarkRadius * scale;
    mark.MarkerLineColor = theme.colour(series.tone);
    mark.MarkerFillColor = theme.colour(series.points[i].filled ? series.tone : Tone::kBackground);
    ImPlot::PlotScatter(fmt::format("##{}{}", series.name, i).c_str(), &x[i], &y[i], 1, mark);
  }
}

// The lines of a series as a chain of small boxes.
void add_lines(const LogSeries& series, float scale, std::vector<LabelBox>& taken) {
  constexpr int kBoxes = 32;  // a segment
  for (std::size_t i = 1; i < series.points.size(); ++i) {
    const ImVec2 a = ImPlot::PlotToPixels(series.points[i - 1].x, series.points[i - 1].y);
    const ImVec2 b = ImPlot::PlotToPixels(series.points[i].x, series.points[i].y);
    for (int box = 0; box <= kBoxes; ++box) {
      const float share = static_cast<float>(box) / static_cast<float>(kBoxes);
      const ImVec2 c(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y));
      taken.push_back({ImVec2(c.x - scale, c.y - scale), ImVec2(c.x + scale, c.y + scale)});
    }
  }
}

LabelBox mark_box(const LogSeries& series, const LogPoint& point, float scale) {
  const ImVec2 centre = ImPlot::PlotToPixels(point.x, point.y);
  const float reach = (series.radius * kMarkRadius + 1.0F) * scale;
  return {ImVec2(centre.x - reach, centre.y - reach), ImVec2(centre.x + reach, centre.y + reach)};
}

// A label without a free place is left out: the table has its number.
void draw_labels(const Theme& theme, const LogPlot& plot, const std::optional<LabelBox>& goal,
                 float scale) {
  const ImVec2 corner = ImPlot::GetPlotPos();
  const ImVec2 size = ImPlot::GetPlotSize();
  TakenPlaces taken{{corner, {corner.x + size.x, corner.y + size.y}}, {}, {}};
  if (goal) taken.texts.push_back(*goal);
  for (const LogSeries& series : plot.series) {
    for (const LogPoint& point : series.points) taken.ink.push_back(mark_box(series, point, scale));
    add_lines(series, scale, taken.ink);
  }
  ImPlot::PushPlotClipRect();
  for (const LogSeries& series : plot.series) {
    for (const LogPoint& point : series.points) {
      if (point.label.empty()) continue;
      const ImVec2 text = ImGui::CalcTextSize(point.label.c_str());
      const auto box =
          place_label(mark_box(series, point, scale), text, series.labels_above, taken);
      if (!box) continue;
      taken.texts.push_back(*box);
      ImPlot::GetPlotDrawList()->AddText(box->from, theme.packed(series.tone), point.label.c_str());
    }
  }
  ImPlot::PopPlotClipRect();
}

// A logarithmic axis has no zero: it is drawn at the bottom with a label.
LogPlot with_zeros_shown(LogPlot plot, const Decades& y) {
  for (LogSeries& series : plot.series) {
    for (LogPoint& point : series.points) {
      if (point.y > 0.0) continue;
      point.y = std::pow(10.0, y.zero);
      point.label += " (0)";
    }
  }
  return plot;
}

// The plot within `size`, with the titles of its axes.
void draw_plot_area(const Theme& theme, const LogPlot& plot, const Decades& x, const Decades& y,
                    ImVec2 size, float scale) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const std::string title = plot.quantity + (plot.unit.empty() ? "" : " (" + plot.unit + ")");
  const ImU32 colour = theme.packed(theme.prints() ? Tone::kText : Tone::kMuted);
  const float below = 1.2F * ImGui::GetFontSize();
  const float room = title_room(title, size.y - 2.0F * below);
  ImVec2 area_corner;
  ImVec2 area_size;
  ImGui::SetCursorScreenPos({corner.x + room, corner.y});
  ImGui::PushFont(theme.fonts.text, kSmallFontSize);
  if (ImPlot::BeginPlot("##plot", {size.x - room - 0.7F * below, size.y - below},
                        plot_flags(false))) {
    set_up_axis(ImAxis_X1, x);
    set_up_axis(ImAxis_Y1, y);
    ImPlot::SetupFinish();
    const std::optional<LabelBox> goal = draw_goal(theme, plot);
    const LogPlot shown = with_zeros_shown(plot, y);
    for (const LogSeries& series : shown.series) {
      if (!series.points.empty()) draw_series(theme, series, scale);
    }
    draw_labels(theme, shown, goal, scale);
    area_corner = ImPlot::GetPlotPos();
    area_size = ImPlot::GetPlotSize();
    ImPlot::EndPlot();
  }
  ImGui::PopFont();
  draw_upright_title(colour, title, corner.x, room, area_corner.y, area_size.y);
  ImGui::SetCursorScreenPos({corner.x, corner.y + size.y - below});
  draw_title_below(colour, plot.x_title, area_corner.x, area_size.x);
}

}  // namespace

std::vector<AxisNumber> axis_numbers(const Decades& decades) {
  constexpr std::array kFew{1, 2, 5};
  constexpr std::array kAll{1, 2, 3, 4, 5, 6, 7, 8, 9};
  constexpr std::size_t kEnough = 2;
  std::vector<AxisNumber> numbers = thinned(decades);
  if (numbers.size() < kEnough) numbers = numbers_of(decades, kFew);
  if (numbers.size() < kEnough) numbers = numbers_of(decades, kAll);
  return numbers;
}

void draw_log_plot(const Theme& theme, const LogPlot& plot, ImVec2 size, float scale) {
  ImGui::BeginChild(plot.title.c_str(), size);
  strong_text(theme, plot.title);
  const std::optional<Decades> x = decades_of(plot, &LogPoint::x);
  const std::optional<Decades> y = decades_of(plot, &LogPoint::y);
  if (x && y) {
    draw_plot_area(theme, plot, *x, *y, ImGui::GetContentRegionAvail(), scale);
  } else {
    wrapped_symbol_text(theme.packed(Tone::kMuted), plot.nothing);
  }
  ImGui::EndChild();
}

void draw_log_legend(const Theme& theme, const LogFigure& figure) {
  const FontScope font(nullptr, kSmallFontSize);
  const float gap = ems(1.6F);
  const float mark = ems(1.35F);
  const std::vector<LogSeries>& all = figure.plots.front().series;
  for (const LogSeries& series : all) {
    begin_key(mark + ImGui::CalcTextSize(series.name.c_str()).x);
    draw_legend_mark(theme, series.tone, series.mark, true);
    draw_key_text(theme.packed(series.tone), series.name, gap);
  }
  const std::string hollow = "hollow: " + figure.hollow;
  begin_key(mark + ImGui::CalcTextSize(hollow.c_str()).x);
  draw_legend_mark(theme, all.front().tone, all.front().mark, false);
  draw_key_text(theme.packed(Tone::kMuted), hollow, gap);
  const std::string numbers = "numbers: " + figure.labels;
  begin_key(ImGui::CalcTextSize(numbers.c_str()).x);
  ImGui::TextDisabled("%s", numbers.c_str());
  if (!figure.missing.empty()) ImGui::TextWrapped("%s", figure.missing.c_str());
}

void draw_legend_mark(const Theme& theme, Tone tone, Mark mark, bool filled) {
  const float em = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 c(corner.x + 0.5F * em, corner.y + 0.5F * ImGui::GetTextLineHeight());
  const float r = 0.34F * em;
  std::array<ImVec2, 4> corners{
      {{c.x - r, c.y - r}, {c.x + r, c.y - r}, {c.x + r, c.y + r}, {c.x - r, c.y + r}}};
  if (mark == Mark::kDiamond) {
    corners = {{{c.x, c.y - r}, {c.x + r, c.y}, {c.x, c.y + r}, {c.x - r, c.y}}};
  }
  constexpr int kCorners = static_cast<int>(corners.size());
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImU32 colour = theme.packed(tone);
  const float weight = 0.1F * em;
  if (mark == Mark::kCircle && filled) {
    list->AddCircleFilled(c, r, colour);
  } else if (mark == Mark::kCircle) {
    list->AddCircle(c, r, colour, 0, weight);
  } else if (filled) {
    list->AddConvexPolyFilled(corners.data(), kCorners, colour);
  } else {
    list->AddPolyline(corners.data(), kCorners, colour, ImDrawFlags_Closed, weight);
  }
  ImGui::Dummy(ImVec2(em, ImGui::GetTextLineHeight()));
  ImGui::SameLine(0.0F, 0.35F * em);
}

void draw_log_figure(const Theme& theme, const LogFigure& figure, ImVec2 size, float scale) {
  const float top = ImGui::GetCursorPosY();
  draw_log_legend(theme, figure);
  ImGui::Spacing();
  const auto count = static_cast<float>(figure.plots.size());
  const float gap = 3.0F * ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 each((size.x - (count - 1.0F) * gap) / count,
                    size.y - (ImGui::GetCursorPosY() - top));
  for (const LogPlot& plot : figure.plots) {
    if (&plot != figure.plots.data()) ImGui::SameLine(0.0F, gap);
    draw_log_plot(theme, plot, each, scale);
  }
}

}  // namespace hapticwall::draw
