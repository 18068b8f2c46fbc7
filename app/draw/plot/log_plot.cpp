#include "app/draw/plot/log_plot.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>

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

// "0.1", "1000", "10⁻⁹", "2·10⁵".
std::string decimal_text(int digit, int exponent) {
  constexpr int kMinPlain = -2;
  constexpr int kMaxPlain = 3;
  if (exponent >= kMinPlain && exponent <= kMaxPlain) {
    return fmt::format("{:g}", digit * std::pow(10.0, exponent));
  }
  constexpr std::array<const char*, 10> kSuperscripts{"⁰", "¹", "²", "³", "⁴",
                                                      "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = digit == 1 ? "10" : fmt::format("{}·10", digit);
  if (exponent < 0) text += "⁻";
  for (const char figure : fmt::format("{}", std::abs(exponent))) {
    text += kSuperscripts.at(static_cast<std::size_t>(figure - '0'));
  }
  return text;
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
  const std::vector<AxisNumber> numbers = axis_numbers(decades);
  std::vector<double> values;
  std::vector<const char*> labels;
  for (const AxisNumber& number : numbers) {
    values.push_back(number.value);
    labels.push_back(number.text.c_str());
  }
  ImPlot::SetupAxisTicks(axis, values.data(), static_cast<int>(values.size()), labels.data());
}

ImPlotMarker plot_marker(Mark mark) {
  if (mark == Mark::kCircle) return ImPlotMarker_Circle;
  return mark == Mark::kSquare ? ImPlotMarker_Square : ImPlotMarker_Diamond;
}

void draw_goal(const Theme& theme, const LogPlot& plot) {
  if (!plot.goal) return;
  ImPlotSpec spec = line_spec(with_alpha(theme.colour(Tone::kMuted), 0.7F));
  spec.Flags |= ImPlotInfLinesFlags_Horizontal;
  const double goal = *plot.goal;
  ImPlot::PlotInfLines("##goal", &goal, 1, spec);
  const std::string text = fmt::format("{:g} {}", goal, plot.unit);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 end = ImPlot::PlotToPixels(ImPlot::GetPlotLimits().X.Max, goal);
  ImPlot::PushPlotClipRect();
  ImPlot::GetPlotDrawList()->AddText(ImVec2(end.x - size.x - 0.5F * size.y, end.y - 1.1F * size.y),
                                     theme.packed(Tone::kMuted), text.c_str());
  ImPlot::PopPlotClipRect();
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

struct Box {
  ImVec2 from;
  ImVec2 to;
};

float overlap(const Box& a, const Box& b) {
  const float width = std::min(a.to.x, b.to.x) - std::max(a.from.x, b.from.x);
  const float height = std::min(a.to.y, b.to.y) - std::max(a.from.y, b.from.y);
  return width > 0.0F && height > 0.0F ? width * height : 0.0F;
}

// The place around `mark` where the text covers least of `taken`; the preferred side comes first.
Box place_label(const Box& mark, ImVec2 text, bool above, const std::vector<Box>& taken) {
  const ImVec2 centre(0.5F * (mark.from.x + mark.to.x), 0.5F * (mark.from.y + mark.to.y));
  const float over = mark.from.y - text.y;
  const float under = mark.to.y;
  const std::array<ImVec2, 2> preferred{{{centre.x, over}, {centre.x - text.x, under}}};
  std::vector<ImVec2> corners{preferred.at(above ? 0 : 1)};
  corners.insert(corners.end(), {{centre.x - 0.5F * text.x, above ? over : under},
                                 {above ? centre.x - text.x : centre.x, above ? over : under},
                                 preferred.at(above ? 1 : 0),
                                 {centre.x - 0.5F * text.x, above ? under : over},
                                 {mark.to.x + 0.2F * text.y, centre.y - 0.5F * text.y},
                                 {mark.from.x - text.x - 0.2F * text.y, centre.y - 0.5F * text.y}});
  Box best;
  float least = -1.0F;
  for (const ImVec2& corner : corners) {
    const Box box{corner, ImVec2(corner.x + text.x, corner.y + text.y)};
    float covered = 0.0F;
    for (const Box& other : taken) covered += overlap(box, other);
    if (least >= 0.0F && covered >= least) continue;
    best = box;
    least = covered;
  }
  return best;
}

// The lines of a series as a chain of small boxes.
void add_lines(const LogSeries& series, float scale, std::vector<Box>& taken) {
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

void draw_labels(const Theme& theme, const LogPlot& plot, float scale) {
  std::vector<Box> taken;
  const auto mark_of = [&](const LogSeries& series, const LogPoint& point) {
    const ImVec2 centre = ImPlot::PlotToPixels(point.x, point.y);
    const float reach = (series.radius * kMarkRadius + 1.0F) * scale;
    return Box{ImVec2(centre.x - reach, centre.y - reach),
               ImVec2(centre.x + reach, centre.y + reach)};
  };
  for (const LogSeries& series : plot.series) {
    for (const LogPoint& point : series.points) taken.push_back(mark_of(series, point));
    add_lines(series, scale, taken);
  }
  ImPlot::PushPlotClipRect();
  for (const LogSeries& series : plot.series) {
    for (const LogPoint& point : series.points) {
      const ImVec2 size = ImGui::CalcTextSize(point.label.c_str());
      const Box box = place_label(mark_of(series, point), size, series.labels_above, taken);
      taken.push_back(box);
      ImPlot::GetPlotDrawList()->AddText(box.from, theme.packed(series.tone), point.label.c_str());
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

void draw_plot_area(const Theme& theme, const LogPlot& plot, const Decades& x, const Decades& y,
                    float scale) {
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const ImVec2 area(free.x, free.y - ImGui::GetTextLineHeightWithSpacing());
  if (ImPlot::BeginPlot("##plot", area, plot_flags(false))) {
    set_up_axis(ImAxis_X1, x);
    set_up_axis(ImAxis_Y1, y);
    ImPlot::SetupFinish();
    draw_goal(theme, plot);
    const LogPlot shown = with_zeros_shown(plot, y);
    for (const LogSeries& series : shown.series) {
      if (!series.points.empty()) draw_series(theme, series, scale);
    }
    draw_labels(theme, shown, scale);
    ImPlot::EndPlot();
  }
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + free.x -
                       ImGui::CalcTextSize(plot.x_title.c_str()).x);
  ImGui::TextDisabled("%s", plot.x_title.c_str());
}

void draw_legend(const Theme& theme, const LogFigure& figure) {
  const FontScope font(nullptr, kSmallFontSize);
  const float gap = 1.6F * ImGui::GetFontSize();
  const std::vector<LogSeries>& all = figure.plots.front().series;
  for (const LogSeries& series : all) {
    draw_legend_mark(theme, series.tone, series.mark, true);
    ImGui::TextColored(theme.colour(series.tone), "%s", series.name.c_str());
    ImGui::SameLine(0.0F, gap);
  }
  draw_legend_mark(theme, all.front().tone, all.front().mark, false);
  ImGui::TextDisabled("hollow: %s", figure.hollow.c_str());
  ImGui::SameLine(0.0F, gap);
  ImGui::TextDisabled("numbers: %s", figure.labels.c_str());
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
  ImGui::SameLine();
  ImGui::TextDisabled("%s", plot.unit.c_str());
  const std::optional<Decades> x = decades_of(plot, &LogPoint::x);
  const std::optional<Decades> y = decades_of(plot, &LogPoint::y);
  ImGui::PushFont(theme.fonts.text, kSmallFontSize);
  if (x && y) {
    draw_plot_area(theme, plot, *x, *y, scale);
  } else {
    ImGui::TextDisabled("%s", plot.nothing.c_str());
  }
  ImGui::PopFont();
  ImGui::EndChild();
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
  draw_legend(theme, figure);
  if (!figure.missing.empty()) {
    const FontScope font(nullptr, kSmallFontSize);
    ImGui::TextWrapped("%s", figure.missing.c_str());
  }
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
