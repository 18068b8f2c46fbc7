#include "app/ui/status_line.h"

#include <fmt/format.h>

#include <string>

#include "app/ui/blind_test.h"
#include "app/ui/replay_state.h"
#include "app/ui/widgets.h"
#include "core/stabiliser/stabiliser.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

// Name in grey, value in digits of constant width: nothing moves while it counts.
void value(const PanelContext& context, const char* name, const std::string& text, Tone tone,
           std::string_view tooltip) {
  ImGui::BeginGroup();
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(0.0F, 0.4F * ImGui::GetFontSize());
  ImGui::PushFont(context.theme.fonts.digits, kSmallFontSize);
  ImGui::TextColored(context.theme.colour(tone), "%s", text.c_str());
  ImGui::PopFont();
  ImGui::EndGroup();
  remember_item(context.state, std::string(name) + " state");
  explain(tooltip);
  ImGui::SameLine(0.0F, 1.3F * ImGui::GetFontSize());
}

void dot(const PanelContext& context, Tone tone) {
  const float size = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddCircleFilled(
      ImVec2(corner.x + 0.3F * size, corner.y + 0.55F * size), 0.28F * size,
      context.theme.packed(tone));
  ImGui::SetCursorScreenPos(ImVec2(corner.x + 0.85F * size, corner.y));
}

// What moves: the simulator, or which device and whether its reports come.
void draw_device_state(const PanelContext& context) {
  const device::DeviceInfo& info = context.session.device_info();
  const bool lost = context.snapshot.link.trouble != device::Trouble::kNone;
  dot(context, lost ? Tone::kBad : Tone::kAccent);
  const bool replaying = replay_of(context.session) != nullptr;
  std::string text = info.is_simulated && !replaying ? "Simulator" : info.name;
  if (context.snapshot.paused) text += ", paused";
  ImGui::TextUnformatted(text.c_str());
  remember_item(context.state, "device state");
  if (replaying) {
    explain("What was recorded: nothing is simulated or moved.");
  } else if (info.is_simulated) {
    explain("Everything on this screen is simulated: no haptic device is connected or moved.");
  } else {
    explain(lost ? device::trouble_text(context.snapshot.link.trouble)
                 : "A real device: the strip on top says whether it pushes.");
  }
  ImGui::SameLine(0.0F, 1.3F * ImGui::GetFontSize());
}

// The rest of the row; what does not fit is in the tooltip.
void draw_realtime_state(const PanelContext& context) {
  const runtime::RealtimeStatus& status = context.session.realtime_status();
  const bool replaying = replay_of(context.session) != nullptr;
  const Tone tone = replaying ? Tone::kMuted : status.fifo_priority ? Tone::kGood : Tone::kWarning;
  dot(context, tone);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushClipRect(corner, ImVec2(corner.x + width, corner.y + 2.0F * ImGui::GetFontSize()),
                      true);
  ImGui::TextColored(context.theme.colour(tone), "%s", status.text.c_str());
  ImGui::PopClipRect();
  const bool cut = ImGui::GetItemRectSize().x > width;
  remember_item(context.state, "realtime");
  std::string tooltip = status.text;
  if (!status.advice.empty()) tooltip += "\n\n" + status.advice;
  if (cut || !status.advice.empty()) explain(tooltip);
}

std::string p99_text(const runtime::Quantiles& quantiles) {
  if (quantiles.count == 0) return "–";
  return fmt::format("p99 {:5.1f}, most {:5.0f} µs",
                     static_cast<double>(quantiles.p99_ns) / kNanosecondsPerMicrosecond,
                     static_cast<double>(quantiles.maximum_ns) / kNanosecondsPerMicrosecond);
}

// What only a loop has; a recording has none.
void draw_loop_values(const PanelContext& context) {
  const runtime::TimingStatistics& timing = context.snapshot.timing;
  const std::uint64_t dropped = context.session.dropped_plot_samples();
  value(context, "missed", fmt::format("{}", timing.missed_ticks),
        timing.missed_ticks > 0 ? Tone::kWarning : Tone::kText,
        fmt::format("Of {} ticks since the start; a missed tick is left out, never caught up with",
                    timing.ticks));
  value(context, "wake-up", p99_text(context.state.timing.wake_latency), Tone::kText,
        "How late the loop woke up: 99 of 100 times at most the first figure, and the worst");
  // The algorithms differ in it.
  value(context, "compute",
        blind_test_runs(context.state) ? "hidden" : p99_text(context.state.timing.compute_time),
        Tone::kText,
        "How long a tick's work took: 99 of 100 times at most the first figure, and the worst");
  value(context, "plot drops", fmt::format("{}", dropped),
        dropped > 0 ? Tone::kWarning : Tone::kText,
        "Samples that the window was too slow to take; the recording has a queue of its own");
}

}  // namespace

void draw_hint_row(const PanelContext& context) {
  if (replay_of(context.session) != nullptr) {
    ImGui::TextDisabled(
        "F1 all keys   P play   ← → step   R to the start   [ ] slower, faster   L repeat   "
        "1–%zu re-run under an algorithm",
        algorithms().size());
    return;
  }
  if (blind_test_runs(context.state)) {
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
        Tone::kText, "Ticks of the loop a second");
  if (replay_of(context.session) == nullptr) draw_loop_values(context);
  value(context, "frame",
        fmt::format("{:4.1f} ms",
                    kMillisecondsPerSecond / static_cast<double>(ImGui::GetIO().Framerate)),
        Tone::kText, "Time from one picture of this window to the next");
  draw_realtime_state(context);
}

}  // namespace hapticwall::ui
