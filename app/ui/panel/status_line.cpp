#include <fmt/format.h>

#include <string>

#include "app/ui/panel/sections.h"
#include "app/ui/widget/widgets.h"
#include "core/stabiliser/stabiliser.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

// Name in grey and digits of constant width, so that nothing moves.
void value(const PanelContext& context, const char* name, const std::string& text, draw::Tone tone,
           std::string_view tooltip) {
  ImGui::BeginGroup();
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(0.0F, 0.4F * ImGui::GetFontSize());
  digits_text(context, text, tone);
  ImGui::EndGroup();
  explain(tooltip);
  ImGui::SameLine(0.0F, 1.3F * ImGui::GetFontSize());
}

void dot(const PanelContext& context, draw::Tone tone) {
  const float size = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddCircleFilled(
      ImVec2(corner.x + 0.3F * size, corner.y + 0.55F * size), 0.28F * size,
      context.theme.packed(tone));
  ImGui::SetCursorScreenPos(ImVec2(corner.x + 0.85F * size, corner.y));
}

// The simulator, or the device and whether its reports arrive.
void draw_device_state(const PanelContext& context) {
  const device::DeviceInfo& info = context.session.device_info();
  const bool lost = context.snapshot.link.trouble != device::Trouble::kNone;
  dot(context, lost ? draw::Tone::kBad : draw::Tone::kAccent);
  const bool replaying = context.shows.replay != nullptr;
  std::string text = info.is_simulated && !replaying ? "Simulator" : info.name;
  if (context.snapshot.paused) text += ", paused";
  ImGui::TextUnformatted(text.c_str());
  if (replaying) {
    explain("A recording: nothing is simulated or moved.");
  } else if (info.is_simulated) {
    explain("Everything on this screen is simulated: no haptic device is connected or moved.");
  } else {
    explain(lost ? device::trouble_text(context.snapshot.link.trouble)
                 : "A real device: the strip at the top shows whether it pushes.");
  }
  ImGui::SameLine(0.0F, 1.3F * ImGui::GetFontSize());
}

// Fills the rest of the row; the tooltip has the whole text.
void draw_realtime_state(const PanelContext& context) {
  const runtime::RealtimeStatus& status = context.session.realtime_status();
  const bool replaying = context.shows.replay != nullptr;
  const draw::Tone tone = replaying              ? draw::Tone::kMuted
                          : status.fifo_priority ? draw::Tone::kGood
                                                 : draw::Tone::kWarning;
  dot(context, tone);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushClipRect(corner, ImVec2(corner.x + width, corner.y + 2.0F * ImGui::GetFontSize()),
                      true);
  ImGui::TextColored(context.theme.colour(tone), "%s", status.text.c_str());
  ImGui::PopClipRect();
  const bool cut = ImGui::GetItemRectSize().x > width;
  std::string tooltip = status.text;
  if (!status.advice.empty()) tooltip += "\n\n" + status.advice;
  if (cut || !status.advice.empty()) explain(tooltip);
}

std::string p99_text(const runtime::Quantiles& quantiles) {
  if (quantiles.count == 0) return "–";
  return fmt::format("p99 {:5.1f}, max {:5.0f} µs",
                     static_cast<double>(quantiles.p99_ns) / kNanosecondsPerMicrosecond,
                     static_cast<double>(quantiles.maximum_ns) / kNanosecondsPerMicrosecond);
}

// Values of the real-time loop; a recording has none.
void draw_loop_values(const PanelContext& context, const runtime::LiveSession& live) {
  const runtime::TimingStatistics& timing = context.snapshot.timing;
  const std::uint64_t dropped = live.dropped_plot_samples();
  value(context, "missed", fmt::format("{}", timing.missed_ticks),
        timing.missed_ticks > 0 ? draw::Tone::kWarning : draw::Tone::kText,
        fmt::format("Of {} ticks since the start; a missed tick is skipped", timing.ticks));
  value(context, "wake-up", p99_text(context.state.timing.wake_latency), draw::Tone::kText,
        "Wake-up latency of the loop: 99th percentile and maximum");
  // The compute time would reveal the algorithm.
  value(context, "compute",
        context.shows.hides_algorithm ? "hidden" : p99_text(context.state.timing.compute_time),
        draw::Tone::kText, "Compute time of a tick: 99th percentile and maximum");
  value(context, "plot drops", fmt::format("{}", dropped),
        dropped > 0 ? draw::Tone::kWarning : draw::Tone::kText,
        "Samples that the window was too slow to take; the recording has its own queue");
}

}  // namespace

void draw_hint_row(const PanelContext& context) {
  if (context.shows.replay != nullptr) {
    ImGui::TextDisabled(
        "F1 all keys   P play   ← → step   R to the start   [ ] slower, faster   L repeat   "
        "1–%zu re-run under an algorithm",
        algorithms().size());
    return;
  }
  if (context.shows.hides_algorithm) {
    ImGui::TextDisabled(
        "F1 all keys   1 or ← first wall   2 or → second wall   with Ctrl: choose it   P pause   "
        "R reset   Space force off");
    return;
  }
  ImGui::TextDisabled(
      "F1 all keys   1–%zu algorithm   P pause   S or → step   R reset   "
      "Ctrl+Z undo      %s",
      algorithms().size(),
      context.session.device_info().is_simulated ? "Drag in the view to lead the hand"
                                                 : "A arm   Space force off");
}

void draw_status_row(const PanelContext& context) {
  draw_device_state(context);
  value(context, "rate", fmt::format("{:g} Hz", context.session.scene().sampling.rate_hz),
        draw::Tone::kText, "Ticks of the loop per second");
  if (context.shows.live != nullptr) draw_loop_values(context, *context.shows.live);
  value(context, "frame",
        context.snapshot.paused
            ? "      –"
            : fmt::format("{:4.1f} ms",
                          kMillisecondsPerSecond / static_cast<double>(ImGui::GetIO().Framerate)),
        draw::Tone::kText, "Time between two frames of this window");
  draw_realtime_state(context);
}

}  // namespace hapticwall::ui
