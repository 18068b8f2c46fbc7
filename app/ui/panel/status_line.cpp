#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/ui/panel/hand_state.h"
#include "app/ui/panel/sections.h"
#include "app/ui/state/timing_state.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/overflow_row.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr float kStatusGapEms = 1.3F;
constexpr float kStatusNameGapEms = 0.4F;
constexpr float kMinRealtimeEms = 10.0F;  // min width of the state of the real-time loop

// Name in grey and digits of constant width, so that nothing moves.
struct StatusValue {
  const char* name;
  std::string text;
  draw::Tone tone;
  std::string tooltip;
  const char* widest = "";  // the widest of the usual texts
};

// State of the real-time loop, in words.
struct StatusText {
  draw::Tone tone;
  std::string text;
  std::string advice;
};

RowControl control_of(const PanelContext& context, int rank, StatusValue value) {
  const float name = ImGui::CalcTextSize(value.name).x + ems(kStatusNameGapEms);
  const draw::FontScope font(context.theme.fonts.digits, draw::kSmallFontSize);
  const float text =
      std::max(ImGui::CalcTextSize(value.text.c_str()).x, ImGui::CalcTextSize(value.widest).x);
  const float width = name + text + ems(kStatusGapEms) - ImGui::GetStyle().ItemSpacing.x;
  return {width, rank, [&context, value = std::move(value)] {
            ImGui::BeginGroup();
            ImGui::TextDisabled("%s", value.name);
            ImGui::SameLine(0.0F, ems(kStatusNameGapEms));
            digits_text(context, value.text, value.tone);
            ImGui::EndGroup();
            explain(value.tooltip);
          }};
}

void dot(const PanelContext& context, draw::Tone tone) {
  const float size = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddCircleFilled(
      ImVec2(corner.x + 0.3F * size, corner.y + 0.55F * size), 0.28F * size,
      context.theme.packed(tone));
  ImGui::SetCursorScreenPos(ImVec2(corner.x + 0.85F * size, corner.y));
}

std::string device_text(const PanelContext& context) {
  const device::DeviceInfo& info = context.session.device_info();
  const bool simulated = info.is_simulated && context.shows.replay == nullptr;
  return (simulated ? "Simulator" : info.name) + (context.snapshot.paused ? ", paused" : "");
}

// The simulator, or the device and whether its reports arrive.
void draw_device_state(const PanelContext& context) {
  const bool lost = context.snapshot.link.trouble != device::Trouble::kNone;
  dot(context, lost ? draw::Tone::kBad : draw::Tone::kAccent);
  ImGui::TextUnformatted(device_text(context).c_str());
  if (context.shows.replay != nullptr) {
    explain("A recording: nothing is simulated or moved.");
  } else if (context.session.device_info().is_simulated) {
    explain("Everything on this screen is simulated: no haptic device is connected or moved.");
  } else {
    explain(lost ? device::trouble_text(context.snapshot.link.trouble)
                 : "A real device: the strip at the top shows whether it pushes.");
  }
}

// The set-up of the loop, unless the loop is silent.
StatusText realtime_text(const PanelContext& context) {
  const session::RealtimeStatus& status = context.session.realtime_status();
  const std::string silence = silence_text(context.timing.answer);
  if (!silence.empty()) {
    return {draw::Tone::kBad, silence,
            "The loop hangs, or the machine gives it no time: other real-time processes, a step "
            "of a plug-in. A device drops its force 20 ms after the last command."};
  }
  const bool judged = context.shows.replay == nullptr && context.can.timing;
  const draw::Tone tone = !judged                ? draw::Tone::kMuted
                          : status.fifo_priority ? draw::Tone::kGood
                                                 : draw::Tone::kWarning;
  return {tone, status.text, status.advice};
}

// Fills the rest of the row; the tooltip has the whole text.
void draw_realtime_state(const PanelContext& context, const StatusText& shown, float kept_px) {
  dot(context, shown.tone);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x - kept_px;
  ImGui::PushClipRect(corner, ImVec2(corner.x + width, corner.y + 2.0F * ImGui::GetFontSize()),
                      true);
  ImGui::TextColored(context.theme.colour(shown.tone), "%s", shown.text.c_str());
  ImGui::PopClipRect();
  const bool cut = ImGui::GetItemRectSize().x > width;
  std::string tooltip = shown.text;
  if (!shown.advice.empty()) tooltip += "\n\n" + shown.advice;
  if (cut || !shown.advice.empty()) explain(tooltip);
}

std::string p99_text(const session::Quantiles& quantiles) {
  if (quantiles.count == 0) return "–";
  return fmt::format("p99 {:5.1f}, max {:5.0f} µs",
                     static_cast<double>(quantiles.p99_ns) / kNanosecondsPerMicrosecond,
                     static_cast<double>(quantiles.maximum_ns) / kNanosecondsPerMicrosecond);
}

// Values of the real-time loop; a recording has none.
std::vector<RowControl> loop_values(const PanelContext& context, const session::LiveSession& live) {
  const session::TimingStatistics& timing = context.snapshot.timing;
  const std::uint64_t dropped = live.dropped_plot_samples();
  std::vector<RowControl> values{control_of(
      context, 1,
      {"missed", fmt::format("{}", timing.missed_ticks),
       timing.missed_ticks > 0 ? draw::Tone::kWarning : draw::Tone::kText,
       fmt::format("Of {} ticks since the start; a missed tick is skipped", timing.ticks),
       "9999"})};
  if (context.can.timing) {
    values.push_back(
        control_of(context, 3,
                   {"wake-up", p99_text(context.timing.wake_latency), draw::Tone::kText,
                    "Wake-up latency of the loop: 99th percentile and maximum"}));
    // The compute time would reveal the algorithm.
    values.push_back(control_of(
        context, 4,
        {"compute",
         context.shows.hides_algorithm ? "hidden" : p99_text(context.timing.compute_time),
         draw::Tone::kText, "Compute time of a tick: 99th percentile and maximum"}));
  }
  values.push_back(
      control_of(context, 2,
                 {"plot drops", fmt::format("{}", dropped),
                  dropped > 0 ? draw::Tone::kWarning : draw::Tone::kText,
                  "Samples that the window was too slow to take; recordings have them", "999"}));
  return values;
}

std::string frame_text(const PanelContext& context) {
  if (context.snapshot.paused) return "      –";
  return fmt::format("{:4.1f} ms",
                     kMillisecondsPerSecond / static_cast<double>(ImGui::GetIO().Framerate));
}

// The one hint that is of use now; empty: none. F1 shows all keys.
std::string hint_text(const PanelContext& context) {
  if (context.shows.hides_algorithm) {
    return "1 or ← first wall   2 or → second wall   with Ctrl: choose it   P pause   R reset   "
           "Space force off   F1 all keys";
  }
  if (context.shows.live == nullptr) return {};
  if (!context.session.device_info().is_simulated) return "A arm   Space force off   F1 all keys";
  return context.hand.led ? std::string() : "Drag in the picture to lead the hand   F1 all keys";
}

// What is wrong, in a sentence; without text nothing is.
StatusText trouble_of(const PanelContext& context) {
  constexpr double kManyMissed = 0.01;  // share of the ticks
  const StatusText realtime = realtime_text(context);
  if (realtime.tone == draw::Tone::kBad) return realtime;
  if (context.snapshot.link.trouble != device::Trouble::kNone) {
    return {draw::Tone::kBad, std::string(device::trouble_text(context.snapshot.link.trouble)), {}};
  }
  if (context.shows.live == nullptr) return {draw::Tone::kMuted, {}, {}};
  const session::TimingStatistics& timing = context.snapshot.timing;
  if (static_cast<double>(timing.missed_ticks) > kManyMissed * static_cast<double>(timing.ticks)) {
    return {draw::Tone::kWarning,
            fmt::format("the loop has missed {} of {} ticks", timing.missed_ticks, timing.ticks),
            {}};
  }
  if (const std::uint64_t dropped = context.shows.live->dropped_plot_samples(); dropped > 0) {
    return {draw::Tone::kWarning,
            fmt::format("the window was too slow for {} samples of the plots", dropped),
            {}};
  }
  return {draw::Tone::kMuted, {}, {}};
}

std::string quiet_text(const PanelContext& context) {
  return fmt::format("{}, {:g} Hz", device_text(context), context.session.scene().sampling.rate_hz);
}

// `kept`: width at the right edge for another item.
void draw_status_row(const PanelContext& context, float kept_px) {
  const float device =
      ImGui::CalcTextSize(device_text(context).c_str()).x + ems(kStatusGapEms + 0.4F);
  std::vector<RowControl> controls{
      {device, 0, [&] { draw_device_state(context); }},
      control_of(context, 5,
                 {"rate", fmt::format("{:g} Hz", context.session.scene().sampling.rate_hz),
                  draw::Tone::kText, "Ticks of the loop per second"})};
  if (context.shows.live != nullptr) {
    for (RowControl& value : loop_values(context, *context.shows.live))
      controls.push_back(std::move(value));
  }
  controls.push_back(control_of(context, 6,
                                {"frame", frame_text(context), draw::Tone::kText,
                                 "Time between two frames of this window", "999.9 ms"}));
  const StatusText realtime = realtime_text(context);
  const float whole = ImGui::CalcTextSize(realtime.text.c_str()).x + ems(2.0F * kStatusGapEms);
  const float kept = kept_px + (realtime.tone == draw::Tone::kBad ? whole : ems(kMinRealtimeEms));
  ImGui::BeginGroup();
  draw_overflow_row(context, "status", controls,
                    {.room = ImGui::GetContentRegionAvail().x - kept, .small = true});
  ImGui::EndGroup();
  ImGui::SameLine(0.0F, ems(kStatusGapEms));
  draw_realtime_state(context, realtime, kept_px);
}

}  // namespace

void draw_foot(const PanelContext& context) {
  bool& open = context.window.status_shown;
  const StatusText trouble = trouble_of(context);
  const std::string text = trouble.text.empty() ? quiet_text(context) : trouble.text;
  const float dot_width = ImGui::GetFontSize();
  const float width = dot_width + (open ? 0.0F : ImGui::CalcTextSize(text.c_str()).x);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float right = corner.x + ImGui::GetContentRegionAvail().x;
  if (open) {
    draw_status_row(context, width + ems(kStatusGapEms));
  } else {
    ImGui::TextDisabled("%s", hint_text(context).c_str());
  }
  ImGui::SetCursorScreenPos(ImVec2(right - width, corner.y));
  if (ImGui::InvisibleButton("###status", ImVec2(width, ImGui::GetTextLineHeight()))) open = !open;
  explain(open ? "Closes the state of the loop (key F4)" : "Opens the state of the loop (key F4)");
  ImGui::SetCursorScreenPos(ImVec2(right - width, corner.y));
  dot(context, trouble.tone);
  if (!open) ImGui::TextColored(context.theme.colour(trouble.tone), "%s", text.c_str());
}

void toggle_status(const PanelContext& context) {
  context.window.status_shown = !context.window.status_shown;
}

}  // namespace hapticwall::ui
