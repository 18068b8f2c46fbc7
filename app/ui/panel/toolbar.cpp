#include "app/ui/panel/toolbar.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "app/file/text/text.h"
#include "app/ui/panel/replay_bar.h"
#include "app/ui/state/export.h"
#include "app/ui/widget/widgets.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::ui {
namespace {

using runtime::RecordingState;
using runtime::RecordingStatus;

constexpr float kToolButtonEms = 6.0F;
constexpr float kRecordButtonEms = 7.0F;
constexpr float kMarkButtonEms = 4.0F;
constexpr float kNameEms = 15.0F;

std::string automatic_name(const PanelContext& context) {
  const Scene& scene = context.session.scene();
  if (context.shows.hides_algorithm) return plain_file_name(scene.name + "-blind-test.csv");
  const auto list = algorithms();
  const bool known = scene.algorithm.index < list.size();
  return plain_file_name(
      fmt::format("{}-{}.csv", scene.name, known ? list[scene.algorithm.index].name : "unknown"));
}

void draw_run_buttons(const PanelContext& context) {
  const bool paused = context.snapshot.paused;
  if (tool_button(paused ? "Run###pause" : "Pause###pause", kToolButtonEms,
                  "Pauses or runs the loop (key P)")) {
    toggle_pause(context);
  }
  ImGui::SameLine();
  ImGui::BeginDisabled(!paused);
  if (tool_button("Step###step", kToolButtonEms, "One tick, while paused (key S or →)"))
    single_step(context);
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (tool_button("Reset###reset", kToolButtonEms,
                  "Back to tick 0 at rest, with the present values (key R). Ends a recording.")) {
    reset_session(context);
  }
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::PushFont(context.theme.fonts.digits, 0.0F);
  ImGui::Text("%9.3f s", context.snapshot.newest.x().time_s);
  ImGui::PopFont();
  explain("Session time since the last reset.");
}

void draw_recording_status(const PanelContext& context, const RecordingStatus& status) {
  if (status.state == RecordingState::kIdle && status.path.empty()) return;
  ImGui::SameLine();
  if (status.state == RecordingState::kFailed) {
    ImGui::TextColored(context.theme.colour(draw::Tone::kBad), "%s", status.error.c_str());
    explain(status.error);
    return;
  }
  const bool lost = status.dropped_rows > 0;
  const draw::Tone tone = lost ? draw::Tone::kBad : draw::Tone::kMuted;
  ImGui::TextColored(context.theme.colour(tone), "%llu rows, %llu dropped",
                     static_cast<unsigned long long>(status.rows),
                     static_cast<unsigned long long>(status.dropped_rows));
  explain(status.path);
}

void draw_name(const PanelContext& context) {
  TransientState& transient = context.state.transient;
  ImGui::SetNextItemWidth(kNameEms * ImGui::GetFontSize());
  const std::string hint = automatic_name(context);
  if (const auto name = text_field(context, "##recording name", hint, transient.recording_name)) {
    transient.recording_name = *name;
  }
  explain(
      "Name of the file; empty: after scene and algorithm. An existing file is never overwritten.");
}

// Replaces the name field during a recording.
void draw_mark(const PanelContext& context) {
  constexpr const char* kTooltip =
      "Marks this moment in the recording, with an optional text: a line in the plots and in the "
      "sidecar (key M)";
  if (tool_button("Mark###mark", kMarkButtonEms, kTooltip)) add_mark(context);
  ImGui::SameLine();
  const float width = kNameEms * ImGui::GetFontSize() - ImGui::GetItemRectSize().x;
  ImGui::SetNextItemWidth(width - ImGui::GetStyle().ItemSpacing.x);
  std::string& text = context.state.transient.mark_text;
  const auto typed = text_field(context, "##mark text", "what happens here", text);
  explain("Text of the next mark; Enter sets it.");
  if (!typed) return;
  text = *typed;
  if (ImGui::IsKeyPressed(ImGuiKey_Enter) || ImGui::IsKeyPressed(ImGuiKey_KeypadEnter))
    add_mark(context);
}

void draw_recording(const PanelContext& context, const runtime::LiveSession& live) {
  const RecordingStatus status = live.recording_status();
  const bool recording = status.state == RecordingState::kRecording;
  // A narrow window gives it its own row.
  const float em = ImGui::GetFontSize();
  ImGui::SameLine(0.0F, 2.0F * em);
  if (ImGui::GetContentRegionAvail().x < (kRecordButtonEms + kNameEms) * em) ImGui::NewLine();
  if (recording)
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.packed(draw::Tone::kBad, 0.55F));
  const bool clicked = tool_button(
      recording ? "Stop###record" : "Record###record", kRecordButtonEms,
      "Writes every tick to a CSV file, with a sidecar that repeats the session (Ctrl+R)");
  if (recording) ImGui::PopStyleColor();
  if (clicked) toggle_recording(context);
  ImGui::SameLine();
  if (recording) {
    draw_mark(context);
  } else {
    draw_name(context);
  }
  draw_recording_status(context, status);
}

}  // namespace

bool tool_button(const char* label, float width_ems, const char* tooltip) {
  const bool clicked = ImGui::Button(label, ImVec2(width_ems * ImGui::GetFontSize(), 0.0F));
  explain(tooltip);
  return clicked;
}

void draw_toolbar(const PanelContext& context) {
  if (context.shows.replay != nullptr) {
    draw_replay_bar(context, *context.shows.replay);
  } else {
    draw_run_buttons(context);
    draw_recording(context, *context.shows.live);
  }
  draw_opening(context);
}

void toggle_pause(const PanelContext& context) { context.session.pause(!context.snapshot.paused); }

void single_step(const PanelContext& context) {
  if (context.snapshot.paused) context.session.step();
}

void reset_session(const PanelContext& context) {
  context.session.reset();
  context.state.transient.follow = true;
}

void toggle_recording(const PanelContext& context) {
  UiState& state = context.state;
  if (context.shows.replay != nullptr) {
    tell(state, MessageKind::kProblem,
         "this is a recording already: " + file::shown(context.shows.replay->recording().csv_path));
    return;
  }
  runtime::LiveSession& live = *context.shows.live;
  if (live.recording_status().state == RecordingState::kRecording) {
    const Failure failure = live.stop_recording();
    const std::string path = live.recording_status().path;
    tell(state, failure ? MessageKind::kProblem : MessageKind::kNote,
         failure ? failure->message : "recording finished: " + path);
    return;
  }
  const std::string& typed = state.transient.recording_name;
  const std::string path = unused_recording_path(state.transient.recording_folder,
                                                 typed.empty() ? automatic_name(context) : typed);
  const Failure failure = live.start_recording(path);
  tell(state, failure ? MessageKind::kProblem : MessageKind::kNote,
       failure ? failure->message : "recording to " + path);
}

void add_mark(const PanelContext& context) {
  TransientState& transient = context.state.transient;
  if (context.shows.replay != nullptr) {
    tell(context.state, MessageKind::kNote, "marks need a running recording; this one is finished");
    return;
  }
  if (const Failure failure = context.shows.live->mark(transient.mark_text)) {
    tell(context.state, MessageKind::kNote, failure->message);
    return;
  }
  transient.mark_text.clear();
}

std::string unused_recording_path(const std::string& folder, const std::string& name) {
  namespace fs = std::filesystem;
  fs::path wanted(name);
  if (wanted.extension() != ".csv") wanted += ".csv";
  const fs::path stem = fs::path(folder) / wanted.parent_path() / wanted.stem();
  const auto taken = [](const fs::path& base) {
    std::error_code ignored;
    for (const char* ending : {".csv", ".toml", ".csv.partial"}) {
      if (fs::exists(base.string() + ending, ignored)) return true;
    }
    return false;
  };
  fs::path base = stem;
  for (int number = 2; taken(base); ++number) base = fmt::format("{}-{}", stem.string(), number);
  return base.string() + ".csv";
}

}  // namespace hapticwall::ui
