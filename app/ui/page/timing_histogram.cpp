#include "app/ui/page/timing_histogram.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/draw/plot/plot_axes.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using session::LatencyBins;
using session::LatencyCounts;

constexpr std::size_t kBinsABar = 4;  // 4 bars to a power of two
constexpr std::size_t kBars = LatencyBins::kCount / kBinsABar;
constexpr double kMinTimeNs = 100.0;  // shorter times are in the first bar
constexpr double kMinCount = 0.6;     // lower end of the count axis; a count of 1 is visible
constexpr double kDecade = 10.0;
constexpr int kLabelRows = 4;          // one per quantile, so that no labels collide
constexpr float kTimeLabelEms = 4.0F;  // room on an axis for one label
constexpr float kCountLabelEms = 2.0F;
constexpr float kRoomForTimesEms = 17.0F;  // minimum width of a plot whose labels show their times

struct Bar {
  std::int64_t from_ns;
  std::int64_t to_ns;
  std::uint64_t count;
};

// The non-empty bins in order; times below the axis share one.
std::vector<Bar> bars_of(const LatencyCounts& counts) {
  std::vector<Bar> bars;
  for (std::size_t i = 0; i < kBars; ++i) {
    const std::size_t bin = i * kBinsABar;
    Bar bar{LatencyBins::from_ns(bin), LatencyBins::from_ns(bin + kBinsABar), 0};
    for (std::size_t j = 0; j < kBinsABar; ++j) bar.count += counts.bins[bin + j];
    if (bar.count == 0) continue;
    const auto axis_ns = static_cast<std::int64_t>(kMinTimeNs);
    if (!bars.empty() && bars.back().to_ns <= axis_ns) {
      bars.back().to_ns = bar.to_ns;
      bars.back().count += bar.count;
    } else {
      bars.push_back(bar);
    }
  }
  return bars;
}

double decade_below(double value) { return std::pow(kDecade, std::floor(std::log10(value))); }
double decade_above(double value) { return std::pow(kDecade, std::ceil(std::log10(value))); }

// Copies as much as fits, with a null at the end; returns the length.
int put_text(const std::string& whole, char* text, int size) {
  const auto result = fmt::format_to_n(text, static_cast<std::size_t>(size - 1), "{}", whole);
  *result.out = '\0';
  return static_cast<int>(result.out - text);
}

// Tick formatter for ImPlot.
int format_time_tick(double value_ns, char* text, int size, void* /*unused*/) {
  return put_text(time_text(static_cast<std::int64_t>(value_ns)), text, size);
}

int format_count_tick(double count, char* text, int size, void* /*unused*/) {
  constexpr double kThousand = 1e3;
  constexpr double kMillion = 1e6;
  const std::string number = count >= kMillion    ? fmt::format("{:g} M", count / kMillion)
                             : count >= kThousand ? fmt::format("{:g} k", count / kThousand)
                                                  : fmt::format("{:g}", count);
  return put_text(number, text, size);
}

// Powers of ten in [from, to), both powers of ten; as many as have `room` for labels.
void set_up_ticks(ImAxis axis, double from, double to, int room) {
  const int decades = static_cast<int>(std::lround(std::log10(to / from)));
  const int step = (decades - 1) / std::max(room, 1) + 1;
  std::vector<double> ticks;
  for (int i = 0; i < decades; i += step) ticks.push_back(from * std::pow(kDecade, i));
  ImPlot::SetupAxisTicks(axis, ticks.data(), static_cast<int>(ticks.size()));
}

void set_up_axes(const TimingHistogram& histogram, const std::vector<Bar>& bars, ImVec2 size) {
  std::uint64_t most = 1;
  for (const Bar& bar : bars) most = std::max(most, bar.count);
  const double shortest = std::max(static_cast<double>(bars.front().from_ns), kMinTimeNs);
  const double longest =
      std::max(static_cast<double>(bars.back().to_ns), static_cast<double>(histogram.period_ns));
  const double from_ns = decade_below(shortest);
  const double to_ns = decade_above(1.5 * longest);
  const double top = decade_above(static_cast<double>(most) + 1.0);
  for (const ImAxis axis : {ImAxis_X1, ImAxis_Y1}) {
    ImPlot::SetupAxis(axis, nullptr, draw::kAxisFlags);
    ImPlot::SetupAxisScale(axis, ImPlotScale_Log10);
  }
  ImPlot::SetupAxisFormat(ImAxis_X1, format_time_tick);
  ImPlot::SetupAxisFormat(ImAxis_Y1, format_count_tick);
  ImPlot::SetupAxisLimits(ImAxis_X1, from_ns, to_ns, ImPlotCond_Always);
  // Leaves room above the highest bar for the labels of the quantiles.
  ImPlot::SetupAxisLimits(ImAxis_Y1, kMinCount, top * kDecade, ImPlotCond_Always);
  set_up_ticks(ImAxis_X1, from_ns, to_ns, static_cast<int>(size.x / draw::ems(kTimeLabelEms)));
  set_up_ticks(ImAxis_Y1, 1.0, top * kDecade, static_cast<int>(size.y / draw::ems(kCountLabelEms)));
  ImPlot::SetupFinish();
}

float pixel_x(double time_ns) { return ImPlot::PlotToPixels(std::max(time_ns, 1.0), 1.0).x; }

// Returns the bar under the pointer, or null.
const Bar* draw_bars(const draw::Theme& theme, const std::vector<Bar>& bars, draw::Tone tone) {
  constexpr float kAlpha = 0.75F;
  const ImVec2 corner = ImPlot::GetPlotPos();
  const float foot = corner.y + ImPlot::GetPlotSize().y;
  const ImVec2 pointer = ImGui::GetMousePos();
  const bool pointed = ImGui::IsWindowHovered() && pointer.y >= corner.y && pointer.y < foot;
  const Bar* under = nullptr;
  ImDrawList* list = ImPlot::GetPlotDrawList();
  for (const Bar& bar : bars) {
    const float left = std::max(pixel_x(static_cast<double>(bar.from_ns)), corner.x);
    const float right = std::max(pixel_x(static_cast<double>(bar.to_ns)), left + 1.0F);
    const float top = ImPlot::PlotToPixels(kMinTimeNs, static_cast<double>(bar.count)).y;
    const bool here = pointed && pointer.x >= left && pointer.x < right;
    if (here) under = &bar;
    // Leaves one pixel between wide bars.
    const float gap = right - left > 3.0F ? 1.0F : 0.0F;
    list->AddRectFilled(ImVec2(left, top), ImVec2(right - gap, foot),
                        theme.packed(tone, here ? 1.0F : kAlpha));
  }
  return under;
}

// A vertical line with its label in one of the top rows.
void draw_mark(const draw::Theme& theme, std::int64_t time_ns, const std::string& label, int row,
               draw::Tone tone) {
  const ImVec2 corner = ImPlot::GetPlotPos();
  const ImVec2 size = ImPlot::GetPlotSize();
  const float x = std::floor(pixel_x(static_cast<double>(time_ns)));
  const ImVec2 text = ImGui::CalcTextSize(label.c_str());
  const float gap = 0.3F * text.y;
  const float y = corner.y + static_cast<float>(row) * text.y;
  const bool fits = x + gap + text.x <= corner.x + size.x;
  const float left = fits ? x + gap : x - gap - text.x;
  ImDrawList* list = ImPlot::GetPlotDrawList();
  list->AddLine(ImVec2(x, y + 0.1F * text.y), ImVec2(x, corner.y + size.y),
                theme.packed(tone, 0.8F));
  list->AddText(ImVec2(left, y), theme.packed(tone), label.c_str());
}

void draw_marks(const draw::Theme& theme, const TimingHistogram& histogram) {
  const session::Quantiles& quantiles = histogram.quantiles;
  draw_mark(theme, histogram.period_ns, "period", kLabelRows, draw::Tone::kBad);
  struct Named {
    const char* name;
    std::int64_t time_ns;
  };
  const std::array<Named, kLabelRows> named{{{"p50", quantiles.median_ns},
                                             {"p99", quantiles.p99_ns},
                                             {"p99.9", quantiles.p999_ns},
                                             {"most", quantiles.maximum_ns}}};
  const bool times = ImPlot::GetPlotSize().x > kRoomForTimesEms * ImGui::GetFontSize();
  for (int row = 0; row < kLabelRows; ++row) {
    const Named& mark = named[static_cast<std::size_t>(row)];
    const std::string label =
        times ? fmt::format("{} {}", mark.name, time_text(mark.time_ns)) : mark.name;
    draw_mark(theme, mark.time_ns, label, row, draw::Tone::kText);
  }
}

void explain_bar(const Bar& bar, std::uint64_t total) {
  ImGui::SetTooltip(
      "%s to %s\n%s", time_text(bar.from_ns).c_str(), time_text(bar.to_ns).c_str(),
      fmt::format("{} of {} cycles, {:.3g} %", bar.count, total,
                  kPercent * static_cast<double>(bar.count) / static_cast<double>(total))
          .c_str());
}

void draw_heading(const draw::Theme& theme, const TimingHistogram& histogram) {
  draw::strong_text(theme, histogram.title);
  ImGui::SetItemTooltip("%s", histogram.meaning);
  ImGui::SameLine();
  ImGui::TextDisabled("cycles");
}

}  // namespace

std::string time_text(std::int64_t time_ns) {
  struct Unit {
    double ns;
    const char* name;
  };
  constexpr std::array kUnits{Unit{1e9, "s"}, Unit{1e6, "ms"}, Unit{1e3, "µs"}};
  const auto time = static_cast<double>(time_ns);
  for (const Unit& unit : kUnits) {
    if (time < unit.ns) continue;
    const double value = time / unit.ns;
    return value >= 100.0 ? fmt::format("{:.0f} {}", value, unit.name)
                          : fmt::format("{:.3g} {}", value, unit.name);
  }
  return fmt::format("{} ns", time_ns);
}

void draw_timing_histogram(const draw::Theme& theme, const TimingHistogram& histogram,
                           ImVec2 size) {
  ImGui::BeginChild(histogram.title, size, ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  draw_heading(theme, histogram);
  const std::vector<Bar> bars = bars_of(*histogram.counts);
  if (bars.empty()) {
    ImGui::TextDisabled("no cycles yet");
    ImGui::EndChild();
    return;
  }
  ImGui::PushFont(theme.fonts.digits, draw::kSmallFontSize);
  const Bar* under = nullptr;
  const ImVec2 free = ImGui::GetContentRegionAvail();
  if (ImPlot::BeginPlot(fmt::format("##plot {}", histogram.title).c_str(), free,
                        draw::plot_flags(false))) {
    set_up_axes(histogram, bars, free);
    ImPlot::PushPlotClipRect();
    under = draw_bars(theme, bars, histogram.tone);
    draw_marks(theme, histogram);
    ImPlot::PopPlotClipRect();
    ImPlot::EndPlot();
  }
  ImGui::PopFont();
  if (under != nullptr) explain_bar(*under, histogram.quantiles.count);
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
