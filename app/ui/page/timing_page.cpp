#include "app/ui/page/timing_page.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/draw/plot/plot_axes.h"
#include "app/session/loop/clock.h"
#include "app/session/loop/timing_verdict.h"
#include "app/ui/page/timing_histogram.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr std::size_t kCyclesForAVerdict = 1000;
constexpr float kSideShare = 0.34F;  // share of the width for the statistics
constexpr float kMinSideEms = 24.0F;
constexpr float kMaxSideEms = 34.0F;
constexpr float kMinPlotEms = 9.0F;
constexpr float kColumnGapEms = 1.5F;
constexpr float kMinRowEms = 54.0F;  // minimum width; below it the statistics stand under the plots
constexpr float kStackedPlotEms = 14.0F;  // height of the plots then
constexpr float kMinFramesEms = 5.0F;

session::TimingJudgement judgement_of(const TimingState& timing, double rate_hz,
                                      const std::string& advice) {
  session::TimingJudgement judgement;
  judge(session::LoopTiming{rate_hz, timing.wake_latency, timing.shown.missed_ticks, advice},
        judgement);
  return judgement;
}

// Right-aligned; returns its left edge.
float draw_clear(const PanelContext& context) {
  constexpr const char* kClear = "Clear###timing clear";
  const ImVec2 corner = ImGui::GetCursorPos();
  draw::align_right(button_width(kClear));
  const float left = ImGui::GetCursorScreenPos().x;
  if (button(kClear, "Restarts the counts on this page. Session and recording are not affected."))
    context.timing.clear_asked = true;
  ImGui::SetCursorPos(corner);
  return left;
}

void draw_head(const PanelContext& context) {
  draw::Tone tone = draw::Tone::kText;
  const std::string sentence =
      timing_sentence(context.timing, context.session.scene().sampling.rate_hz, tone);
  const float right = draw_clear(context) - ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(corner, ImVec2(right, corner.y + ImGui::GetFrameHeight()), true);
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, context.theme.colour(tone));
  draw::strong_text(context.theme, sentence);
  ImGui::PopStyleColor();
  ImGui::PopClipRect();
  // The tooltip has the whole text.
  explain(
      sentence +
      "\n\nGood: no tick missed, and 999 of 1000 wake-ups within a tenth of the period. Usable: "
      "at most one tick in 10 000 missed, 999 of 1000 within half of it. `hapticwall "
      "timing` uses the same limits.");
}

void quantile_cells(const PanelContext& context, const session::Quantiles& quantiles) {
  const FontScope font(context.theme.fonts.digits, draw::kSmallFontSize);
  for (const std::int64_t time_ns :
       {quantiles.median_ns, quantiles.p99_ns, quantiles.p999_ns, quantiles.maximum_ns}) {
    ImGui::TableNextColumn();
    draw::right_aligned_text(
        quantiles.count == 0
            ? "–"
            : fmt::format("{:.1f}", static_cast<double>(time_ns) / kNanosecondsPerMicrosecond));
  }
}

void quantile_row(const PanelContext& context, const char* name, const char* tooltip,
                  const session::Quantiles& quantiles) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(name);
  explain(tooltip);
  quantile_cells(context, quantiles);
}

void draw_quantiles(const PanelContext& context) {
  struct Heading {
    const char* name;
    const char* tooltip;
  };
  constexpr std::array kHeadings{
      Heading{"median", "Half of all cycles are at most this (right to 1 part in 32)"},
      Heading{"p99", "99 of 100 cycles are at most this (right to 1 part in 32)"},
      Heading{"p99.9", "999 of 1000 cycles are at most this (right to 1 part in 32)"},
      Heading{"max", "The largest of all cycles; exact since the start of the session"}};
  constexpr int kColumns = 1 + static_cast<int>(kHeadings.size());
  if (!ImGui::BeginTable("quantiles", kColumns, ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("µs");
  for (const Heading& heading : kHeadings) {
    ImGui::TableNextColumn();
    draw::align_right(ImGui::CalcTextSize(heading.name).x);
    ImGui::TextDisabled("%s", heading.name);
    explain(heading.tooltip);
  }
  const TimingState& timing = context.timing;
  quantile_row(context, "wake-up", "Delay of the wake-up after the requested time",
               timing.wake_latency);
  quantile_row(context, "compute",
               "From wake-up to the last output: device, algorithm, ledger, queues",
               timing.compute_time);
  ImGui::EndTable();
}

void draw_counters(const PanelContext& context) {
  const TimingState& timing = context.timing;
  const TimingCounters& shown = timing.shown;
  const auto tone = [](std::uint64_t count) {
    return count > 0 ? draw::Tone::kWarning : draw::Tone::kText;
  };
  figure_row(context, "ticks",
             fmt::format("{} since {}", shown.ticks,
                         timing.since_start() ? "the start" : "it was cleared"),
             draw::Tone::kText, "Executed ticks of the loop; a pause has none");
  figure_row(context, "missed ticks", fmt::format("{}", shown.missed_ticks),
             tone(shown.missed_ticks),
             "Ticks that the loop slept through; they are skipped. A simulation stays correct and "
             "falls behind the clock.");
  figure_row(context, "plot drops", fmt::format("{}", shown.plot_drops), tone(shown.plot_drops),
             "Samples that the window was too slow to take; the recording has its own queue");
}

void draw_realtime(const PanelContext& context) {
  const session::RealtimeStatus& status = context.session.realtime_status();
  const std::string silence = silence_text(context.timing.answer);
  const draw::Tone tone = !silence.empty()       ? draw::Tone::kBad
                          : status.fifo_priority ? draw::Tone::kGood
                                                 : draw::Tone::kWarning;
  draw::wrapped_text(context.theme.colour(tone), silence.empty() ? status.text : silence);
  explain("Priority, memory lock and core of the loop's thread");
  const session::TimingJudgement judgement =
      judgement_of(context.timing, context.session.scene().sampling.rate_hz, status.advice);
  if (!status.advice.empty()) {
    muted_text(context, "Advice: " + status.advice);
  } else if (!judgement.advice.empty() && context.timing.wake_latency.count >= kCyclesForAVerdict) {
    muted_text(context, "Advice: " + judgement.advice.front());
  }
}

void draw_frame_plot(const draw::Theme& theme, std::span<const double> times_ms, double top_ms,
                     float height) {
  if (!ImPlot::BeginPlot("##frames", ImVec2(-1.0F, height), draw::plot_flags(false))) return;
  ImPlot::SetupAxis(ImAxis_X1, nullptr, draw::kAxisFlags | ImPlotAxisFlags_NoDecorations);
  ImPlot::SetupAxis(ImAxis_Y1, nullptr, draw::kAxisFlags);
  ImPlot::SetupAxisFormat(ImAxis_Y1, "%g ms");
  ImPlot::SetupAxisLimits(ImAxis_X1, 0.0, static_cast<double>(FrameTimes::kKept),
                          ImPlotCond_Always);
  ImPlot::SetupAxisLimits(ImAxis_Y1, 0.0, top_ms, ImPlotCond_Always);
  ImPlot::SetupFinish();
  // The newest is at the right edge.
  const auto first = static_cast<double>(FrameTimes::kKept - times_ms.size());
  ImPlot::PlotLine("##times", times_ms.data(), static_cast<int>(times_ms.size()), 1.0, first,
                   draw::line_spec(theme.colour(draw::Tone::kAccent)));
  ImPlot::EndPlot();
}

// The smallest of 1, 2, 5 times a power of ten above `value`.
double round_above(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-3))));
  for (const double step : {2.0, 5.0}) {
    if (step * decade > value) return step * decade;
  }
  return 10.0 * decade;
}

void draw_frames(const PanelContext& context) {
  const FrameTimes& frames = context.timing.frames;
  const FrameStats figures = frame_stats(frames);
  const std::string text = frames.size() == 0
                               ? "–"
                               : fmt::format("mean {:.1f}, p99 {:.1f}, max {:.1f} ms",
                                             figures.mean_ms, figures.p99_ms, figures.maximum_ms);
  figure_row(context, "frame", text, draw::Tone::kText,
             fmt::format("Time to draw this window, of the newest {} frames. It includes waiting "
                         "for the driver of the screen. The loop does not wait.",
                         FrameTimes::kKept));
  if (frames.size() == 0) return;
  FrameTimes::Series series{};
  const std::span<const double> times_ms = frames.copy_ms(series);
  const float height = std::max(ImGui::GetContentRegionAvail().y, ems(kMinFramesEms));
  const FontScope font(context.theme.fonts.digits, draw::kSmallFontSize);
  draw_frame_plot(context.theme, times_ms, round_above(figures.maximum_ms), height);
}

void draw_histograms(const PanelContext& context, ImVec2 size) {
  const TimingState& timing = context.timing;
  const auto period_ns = static_cast<std::int64_t>(
      std::llround(context.session.scene().sampling.period_s() * session::kNanosecondsPerSecond));
  const float gap = ImGui::GetFontSize();
  const ImVec2 each(std::floor(0.5F * (size.x - gap)), size.y);
  draw_timing_histogram(
      context.theme,
      {"Wake-up latency", "Number of cycles for each wake-up latency",
       &timing.shown.histograms.wake_latency, timing.wake_latency, period_ns, draw::Tone::kAccent},
      each);
  ImGui::SameLine(0.0F, gap);
  draw_timing_histogram(context.theme,
                        {"Compute time", "Number of cycles for each compute time",
                         &timing.shown.histograms.compute_time, timing.compute_time, period_ns,
                         draw::Tone::kStiffness},
                        each);
}

void draw_figures(const PanelContext& context) {
  draw_quantiles(context);
  draw_counters(context);
  draw_realtime(context);
  draw_frames(context);
}

}  // namespace

std::string timing_sentence(const TimingState& timing, double rate_hz, draw::Tone& tone) {
  tone = draw::Tone::kMuted;
  if (timing.wake_latency.count == 0) return "No loop runs here.";
  if (timing.wake_latency.count < kCyclesForAVerdict) {
    return fmt::format("Measuring: a verdict comes after {} cycles.", kCyclesForAVerdict);
  }
  const double period_us = kMicrosecondsPerSecond / rate_hz;
  const auto late = [&](const char* name, std::int64_t late_ns) {
    return fmt::format("{} {:.0f} µs late of a {:.4g} µs period", name,
                       static_cast<double>(late_ns) / kNanosecondsPerMicrosecond, period_us);
  };
  const std::string missed =
      timing.shown.missed_ticks == 0
          ? ""
          : fmt::format(", {} of {} ticks missed", timing.shown.missed_ticks,
                        timing.wake_latency.count + timing.shown.missed_ticks);
  switch (judgement_of(timing, rate_hz, "").verdict) {
    case session::TimingVerdict::kGood:
      tone = draw::Tone::kGood;
      return fmt::format("The loop meets its deadlines: {}.",
                         late("p99", timing.wake_latency.p99_ns));
    case session::TimingVerdict::kUsable:
      tone = draw::Tone::kWarning;
      return fmt::format("The loop mostly meets its deadlines: {}{}.",
                         late("p99.9", timing.wake_latency.p999_ns), missed);
    case session::TimingVerdict::kPoor:
      break;
  }
  tone = draw::Tone::kBad;
  return fmt::format("The loop misses its deadlines: {}{}.",
                     late("p99.9", timing.wake_latency.p999_ns), missed);
}

void draw_timing_page(const PanelContext& context) {
  draw_head(context);
  const ImVec2 free = ImGui::GetContentRegionAvail();
  if (free.x < ems(kMinRowEms)) {
    draw_histograms(context, ImVec2(free.x, ems(kStackedPlotEms)));
    draw_figures(context);
    return;
  }
  const float side = std::clamp(kSideShare * free.x, ems(kMinSideEms), ems(kMaxSideEms));
  const float height = std::max(free.y, ems(kMinPlotEms));
  draw_histograms(context, ImVec2(free.x - side - ems(kColumnGapEms), height));
  ImGui::SameLine(0.0F, ems(kColumnGapEms));
  ImGui::BeginChild("timing figures", ImVec2(0.0F, height));
  draw_figures(context);
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
