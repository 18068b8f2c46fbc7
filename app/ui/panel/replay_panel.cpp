#include "app/ui/panel/replay_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/draw/plot/extra_traces.h"
#include "app/session/hand_rerun.h"
#include "app/ui/panel/replay_state.h"
#include "app/ui/state/plots_state.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using session::ReplaySession;

constexpr double kReadShare = 0.3;  // share of the work: the file is read once more
constexpr const char* kNothing = "nothing";

using Progress = Background<LaidOver>::Progress;

Result<LaidOver> rerun(const file::RecordingInfo& shown, const std::string& algorithm,
                       const Progress& progress) {
  // Opens its own reader, because the session uses its reader meanwhile.
  auto reader = file::RecordingReader::open(
      shown.csv_path, [&](double fraction) { return progress(kReadShare * fraction); });
  if (!reader) return reader.error();
  const file::ScannedRows& rows = (*reader)->info().scanned;
  if (rows.rows != shown.scanned.rows || rows.first_tick != shown.scanned.first_tick) {
    return Error{ErrorKind::kUsage,
                 shown.csv_path + ": not the file any more that was opened; open it again"};
  }
  auto overlay = session::rerun_as_overlay(**reader, algorithm, {}, [&](double fraction) {
    return progress(kReadShare + (1.0 - kReadShare) * fraction);
  });
  if (!overlay) return overlay.error();
  auto history = history_of(*overlay, (*reader)->info().loaded.scene.x().device);
  return LaidOver{std::move(*overlay), std::move(history)};
}

void take_away(const PanelContext& context, ReplaySession& replay) {
  context.replay.rerun.give_up();
  replay.lay_over(std::nullopt);
  draw_overlay_in_plots(context.plots, nullptr, nullptr);
}

void draw_choices(const PanelContext& context, ReplaySession& replay, const std::string& current) {
  if (list_choice(fmt::format("{0}###re-run {0}", kNothing), current == kNothing))
    take_away(context, replay);
  for (const AlgorithmDescription& algorithm : algorithms()) {
    const std::string name(algorithm.name);
    if (list_choice(fmt::format("{0}###re-run {0}", name), current == name,
                    fmt::format("{}\n{}", algorithm.title, algorithm.idea)))
      start_rerun(context.replay, context.toasts, replay, name);
  }
}

void draw_rerun(const PanelContext& context, ReplaySession& replay) {
  const ReplayState& state = context.replay;
  const Failure impossible = session::check_rerun(replay.recording());
  const std::string tooltip = impossible ? impossible->message
                                         : "Re-runs the recorded hand under another algorithm, and "
                                           "draws it over the plots as wide, soft lines.";
  field_label(context, "re-run under", tooltip, "");
  const std::string current = state.rerun.running()         ? state.rerun_algorithm
                              : replay.overlay() != nullptr ? replay.overlay()->label
                                                            : kNothing;
  ImGui::BeginDisabled(impossible.has_value());
  if (ImGui::BeginCombo("##re-run", current.c_str(), ImGuiComboFlags_HeightLargest)) {
    draw_choices(context, replay, current);
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
  explain(tooltip);
}

void draw_progress(const PanelContext& context) {
  ReplayState& state = context.replay;
  if (!state.rerun.running()) return;
  const double fraction = state.rerun.fraction();
  const float width =
      ImGui::GetContentRegionAvail().x - button_width("Cancel") - ImGui::GetStyle().ItemSpacing.x;
  ImGui::ProgressBar(static_cast<float>(fraction), ImVec2(std::max(width, 1.0F), 0.0F),
                     fmt::format("{:.0f} %", kPercent * fraction).c_str());
  ImGui::SameLine();
  if (ImGui::Button("Cancel###cancel re-run")) state.rerun.give_up();
}

// Device, time and contents of a recording, in words.
std::string origin(const file::RecordingInfo& recording) {
  std::string text = recording.device.empty() ? "Of an unknown device" : "Of " + recording.device;
  if (!recording.start_time.empty()) text += ", " + recording.start_time;
  const std::size_t marks = recording.loaded.marks.size();
  const std::size_t changes = recording.loaded.changes.size();
  text += fmt::format(". {} rows", recording.scanned.rows);
  if (changes > 0) text += fmt::format(", {} change{}", changes, changes == 1 ? "" : "s");
  if (marks > 0) text += fmt::format(", {} mark{}", marks, marks == 1 ? "" : "s");
  return text + ".";
}

}  // namespace

void draw_replay_section(const PanelContext& context, ReplaySession& replay) {
  const file::RecordingInfo& recording = replay.recording();
  section(context, "Recording");
  const std::string name = std::filesystem::path(recording.csv_path).filename().string();
  ImGui::TextUnformatted(name.c_str());
  explain(recording.csv_path);
  muted_text(context, origin(recording));
  ImGui::PushFont(nullptr, draw::kSmallFontSize);
  for (const std::string& note : recording.notes)
    draw::wrapped_text(context.theme.colour(draw::Tone::kWarning), note);
  ImGui::PopFont();
  draw_rerun(context, replay);
  draw_progress(context);
  muted_text(context,
             "Everything below shows the recorded state at this time and cannot be changed.");
}

void start_rerun(ReplayState& state, Toasts& toasts, const ReplaySession& replay,
                 const std::string& algorithm) {
  if (const Failure impossible = session::check_rerun(replay.recording()))
    return tell(toasts, *impossible);
  state.rerun_algorithm = algorithm;
  state.rerun.start([shown = replay.recording(), algorithm](const Progress& progress) {
    return rerun(shown, algorithm, progress);
  });
}

void notice_rerun(ReplayState& state, PlotsState& plots, Toasts& toasts, ReplaySession& replay) {
  auto outcome = state.rerun.take();
  if (!outcome) return;
  if (!*outcome) return tell(toasts, outcome->error());
  LaidOver laid = std::move(**outcome);
  draw_overlay_in_plots(plots, &laid.overlay, std::move(laid.history));
  replay.lay_over(std::move(laid.overlay));
}

void draw_overlay_in_plots(PlotsState& plots, const session::Overlay* overlay,
                           std::shared_ptr<const draw::SampleHistory> history) {
  std::vector<draw::ExtraTrace> traces;
  if (overlay != nullptr) {
    draw::ExtraTrace trace;
    trace.label = "under " + overlay->label;
    trace.history = std::move(history);
    traces.push_back(std::move(trace));
  }
  replace_extra_traces(plots.transient.extra_traces, draw::ExtraSource::kReplay, std::move(traces));
}

std::shared_ptr<const draw::SampleHistory> history_of(const session::Overlay& overlay,
                                                      const DeviceSettings& device) {
  auto history = std::make_shared<draw::SampleHistory>(overlay.samples.size(), device.encoder_m);
  history->push(overlay.samples);
  return history;
}

}  // namespace hapticwall::ui
