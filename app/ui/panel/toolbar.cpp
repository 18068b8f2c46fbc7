#include "app/ui/panel/toolbar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

#include "app/file/text/text.h"
#include "app/ui/panel/hand_state.h"
#include "app/ui/panel/replay_bar.h"
#include "app/ui/panel/sections.h"
#include "app/ui/panel/sound_switch.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/export.h"
#include "app/ui/state/recording_wishes.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/state/text_edit.h"
#include "app/ui/state/time_view.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/overflow_row.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr std::array<std::uint32_t, 10> kSlowMotions{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};

using session::RecordingState;
using session::RecordingStatus;

constexpr const char* kLess = "Less###less";
constexpr float kToolButtonEms = 4.6F;
constexpr float kTimeEms = 6.8F;
constexpr float kRecordButtonEms = 5.2F;
constexpr float kMarkButtonEms = 3.6F;
constexpr float kNameEms = 12.0F;
constexpr float kSlowEms = 6.5F;
constexpr float kStatusEms = 11.5F;

std::string automatic_name(const PanelContext& context) {
  const Scene& scene = context.session.scene();
  if (context.shows.hides_algorithm) return plain_file_name(scene.name + "-blind-test.csv");
  return plain_file_name(fmt::format("{}-{}.csv", scene.name, algorithm_name(scene.algorithm)));
}

void draw_pause(const PanelContext& context) {
  const bool paused = context.snapshot.paused;
  if (button(paused ? "Run###pause" : "Pause###pause", "Pauses or runs the loop (key P)",
             {.width = ems(kToolButtonEms)}))
    toggle_pause(context);
}

void draw_step_button(const PanelContext& context) {
  if (button("Step###step", "One tick, while paused (key S or →)",
             {.width = ems(kToolButtonEms), .enabled = context.snapshot.paused}))
    single_step(context);
}

void draw_reset(const PanelContext& context) {
  if (button("Reset###reset", "Back to tick 0 at rest, with the present values (key R)",
             {.width = ems(kToolButtonEms)}))
    ask_to_reset(context);
  point_at_reset(context);
}

void draw_repeat(const PanelContext& context) {
  bool& repeats = context.scene.repeats;
  if (choice_button(
          context, "Repeat###repeat scene", repeats,
          context.can.files
              ? "A simulated scene begins anew, at rest, at its end; not while it is recorded or "
                "the pointer leads the hand"
              : "A simulated scene begins anew, at rest, at its end; not while the pointer leads "
                "the hand",
          {.width = ems(kToolButtonEms)}))
    repeats = !repeats;
}

void draw_session_time(const PanelContext& context) {
  ImGui::AlignTextToFramePadding();
  ImGui::PushFont(context.theme.fonts.digits, 0.0F);
  ImGui::Text("%9.3f s", context.snapshot.newest.x().time_s);
  ImGui::PopFont();
  explain("Session time since the last reset.");
}

std::string slowness_text(std::uint32_t periods) {
  return periods == 1 ? "full speed" : fmt::format("1/{}", periods);
}

void draw_slow_motion(const PanelContext& context, session::LiveSession& live) {
  const std::uint32_t now = context.snapshot.periods_per_tick;
  ImGui::SetNextItemWidth(ems(kSlowEms));
  if (ImGui::BeginCombo("##slow motion", slowness_text(now).c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const std::uint32_t periods : kSlowMotions) {
      if (list_choice(fmt::format("{}###slow motion {}", slowness_text(periods), periods),
                      periods == now))
        live.slow_down(periods);
    }
    ImGui::EndCombo();
  }
  explain(
      "Slow motion of the simulator: one tick every this many periods (keys [ and ]). The samples "
      "are those of full speed.");
}

void draw_recording_status(const PanelContext& context, const RecordingStatus& status) {
  ImGui::AlignTextToFramePadding();
  if (status.state == RecordingState::kFailed) {
    ImGui::TextColored(context.theme.colour(draw::Tone::kBad), "%s", status.error.c_str());
    explain(status.error);
    return;
  }
  const draw::Tone tone = status.dropped_rows > 0 ? draw::Tone::kBad : draw::Tone::kMuted;
  ImGui::TextColored(context.theme.colour(tone), "%llu rows, %llu dropped",
                     static_cast<unsigned long long>(status.rows),
                     static_cast<unsigned long long>(status.dropped_rows));
  explain(status.path);
}

void draw_name(const PanelContext& context) {
  ImGui::SetNextItemWidth(ems(kNameEms));
  const std::string hint = automatic_name(context);
  if (const auto name = text_field(context, "##recording name", hint, context.recording.name)) {
    context.recording.name = *name;
  }
  explain(
      "Name of the file; empty: after scene and algorithm. An existing file is never overwritten.");
}

// Replaces the name field during a recording.
void draw_mark(const PanelContext& context) {
  constexpr const char* kTooltip =
      "Marks this moment in the recording, with an optional text: a line in the plots and in the "
      "sidecar (key M)";
  if (button("Mark###mark", kTooltip, {.width = ems(kMarkButtonEms)}))
    static_cast<void>(add_mark(context));
  ImGui::SameLine();
  const float width = ems(kNameEms) - ImGui::GetItemRectSize().x;
  ImGui::SetNextItemWidth(width - ImGui::GetStyle().ItemSpacing.x);
  if (context.recording.focus_mark) ImGui::SetKeyboardFocusHere();
  const bool asked = std::exchange(context.recording.focus_mark, false);
  const auto typed =
      text_field(context, "##mark text", "what happens here", context.recording.mark_text);
  explain("Text of the next mark, or after M of the mark just set; Enter sets it.");
  if (!typed) {
    // Left without a text: the mark has no name.
    if (!asked && ImGui::IsItemDeactivated()) context.recording.names_mark = false;
    return;
  }
  if (std::exchange(context.recording.names_mark, false)) {
    context.shows.live->name_mark(*typed);
    return;
  }
  context.recording.mark_text = *typed;
  if (ImGui::IsKeyPressed(ImGuiKey_Enter) || ImGui::IsKeyPressed(ImGuiKey_KeypadEnter))
    static_cast<void>(add_mark(context));
}

void draw_record(const PanelContext& context, bool recording) {
  if (recording)
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.packed(draw::Tone::kBad, 0.55F));
  const bool clicked =
      button(recording ? "Stop###record" : "Record###record",
             "Writes every tick to a CSV file, with a sidecar that repeats the session (Ctrl+R)",
             {.width = ems(kRecordButtonEms)});
  if (recording) ImGui::PopStyleColor();
  if (clicked) toggle_recording(context);
}

void draw_name_or_mark(const PanelContext& context, bool recording) {
  if (recording) {
    draw_mark(context);
  } else {
    draw_name(context);
  }
}

void draw_session_bar(const PanelContext& context, session::LiveSession& live) {
  const RecordingStatus status = live.recording_status();
  const bool recording = status.state == RecordingState::kRecording;
  std::vector<RowControl> controls{{ems(kToolButtonEms), 0, [&] { draw_pause(context); }},
                                   {ems(kToolButtonEms), 5, [&] { draw_step_button(context); }},
                                   {ems(kToolButtonEms), 2, [&] { draw_reset(context); }},
                                   {ems(kTimeEms), 3, [&] { draw_session_time(context); }}};
  if (context.can.files) {
    controls.push_back({ems(kRecordButtonEms), 1, [&] { draw_record(context, recording); }});
    controls.push_back({ems(kNameEms),
                        6,
                        [&] { draw_name_or_mark(context, recording); },
                        {},
                        context.recording.focus_mark});
  }
  if (context.sound.available)
    controls.push_back({ems(kSoundEms), 4, [&] { draw_sound_switch(context); }});
  if (!context.sound.status.card.empty())
    controls.push_back({ems(kVolumeEms), 8, [&] { draw_volume(context); }});
  if (live.device_info().is_simulated)
    controls.push_back({ems(kSlowEms), 9, [&] { draw_slow_motion(context, live); }});
  controls.push_back({ems(kToolButtonEms), 10, [&] { draw_repeat(context); }});
  if (status.state != RecordingState::kIdle || !status.path.empty())
    controls.push_back({ems(kStatusEms), 7, [&] { draw_recording_status(context, status); }});
  const float less = context.window.more ? button_width(kLess) : 0.0F;
  const float room = ImGui::GetContentRegionAvail().x - less - ImGui::GetStyle().ItemSpacing.x;
  draw_overflow_row(context, "session", controls, {.room = room});
  if (!context.window.more || context.shows.hides_algorithm) return;
  ImGui::SameLine();
  draw::align_right(less);
  if (button(kLess, "Back to the window as it opens; the layout stays")) show_less(context.window);
}

// Question below the reset button; R again confirms, Esc cancels.
void draw_reset_question(const PanelContext& context) {
  constexpr const char* kPopup = "reset the recording";
  Question& question = context.recording.reset_question;
  if (question == Question::kNone) return;
  if (question == Question::kAsked) ImGui::OpenPopup(kPopup);
  question = Question::kShown;
  if (!ImGui::BeginPopup(kPopup)) {
    question = Question::kNone;  // a click elsewhere, or Esc
    return;
  }
  ImGui::TextUnformatted("A recording runs. A reset ends it.");
  if (button("End it and reset (R)###agree to reset", "")) reset_session(context);
  ImGui::SameLine();
  if (button("Go on recording (Esc)###go on recording", "")) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace

void draw_toolbar(const PanelContext& context) {
  if (context.shows.replay != nullptr) {
    draw_replay_bar(context, *context.shows.replay);
  } else {
    draw_session_bar(context, *context.shows.live);
    draw_reset_question(context);
  }
  draw_opening(context);
}

void change_slow_motion(const PanelContext& context, int steps) {
  session::LiveSession* live = context.shows.live;
  if (live == nullptr || !live->device_info().is_simulated) return;
  const auto* now = std::ranges::lower_bound(kSlowMotions, context.snapshot.periods_per_tick);
  const std::ptrdiff_t last = std::ssize(kSlowMotions) - 1;
  const std::ptrdiff_t index =
      std::clamp<std::ptrdiff_t>(now - kSlowMotions.begin() + steps, 0, last);
  live->slow_down(kSlowMotions[static_cast<std::size_t>(index)]);
}

void toggle_pause(const PanelContext& context) { context.session.pause(!context.snapshot.paused); }

void single_step(const PanelContext& context) {
  if (context.snapshot.paused) context.session.step();
}

void ask_to_reset(const PanelContext& context) {
  const bool recording = context.shows.live != nullptr &&
                         context.shows.live->recording_status().state == RecordingState::kRecording;
  if (recording && context.recording.reset_question == Question::kNone) {
    context.recording.reset_question = Question::kAsked;
  } else {
    reset_session(context);
  }
}

void reset_session(const PanelContext& context) {
  context.recording.reset_question = Question::kNone;
  context.session.reset();
  note_reset(context.tour);
  context.time.follow = true;
  context.hand.led = false;
}

void toggle_recording(const PanelContext& context) {
  if (context.shows.replay != nullptr) {
    context.toasts.tell(
        MessageKind::kProblem,
        "this is a recording already: " + file::shown(context.shows.replay->recording().csv_path));
    return;
  }
  session::LiveSession& live = *context.shows.live;
  if (live.recording_status().state == RecordingState::kRecording) {
    stop_recording(context.toasts, live);
    return;
  }
  const std::string& typed = context.recording.name;
  const std::string path = unused_recording_path(context.recording.folder,
                                                 typed.empty() ? automatic_name(context) : typed);
  live.record_signals(context.recording.records_signals);
  tell(context.toasts, live.start_recording(path), "recording to " + path);
}

void stop_recording(Toasts& toasts, session::LiveSession& live) {
  const Failure failure = live.stop_recording();
  tell(toasts, failure, "recording finished: " + live.recording_status().path);
}

bool add_mark(const PanelContext& context) {
  if (context.shows.replay != nullptr) {
    context.toasts.tell(MessageKind::kNote, "marks need a running recording; this one is finished");
    return false;
  }
  if (const Failure failure = context.shows.live->mark(context.recording.mark_text)) {
    context.toasts.tell(MessageKind::kNote, failure->message);
    return false;
  }
  context.recording.mark_text.clear();
  return true;
}

void mark_and_name(const PanelContext& context) {
  if (!add_mark(context)) return;
  context.recording.focus_mark = context.recording.names_mark = true;
  promise_keyboard(context.edit);
}

std::string unused_recording_path(const std::string& folder, const std::string& name) {
  namespace fs = std::filesystem;
  fs::path wanted(name);
  if (wanted.extension() == ".csv") wanted.replace_extension();
  return unused_base(folder, wanted.string(), {".csv", ".toml", ".csv.partial"}) + ".csv";
}

}  // namespace hapticwall::ui
