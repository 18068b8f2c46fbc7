#include "app/ui/panel/replay_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>

#include "app/file/recording/recording_writer.h"
#include "app/ui/panel/replay_state.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/state/time_view.h"
#include "app/ui/widget/overflow_row.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

using session::kMaxReplaySpeed;
using session::kMinReplaySpeed;
using session::ReplaySession;

constexpr std::array kSpeeds{
    kMinReplaySpeed, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, kMaxReplaySpeed};
// History that is read before the target of a jump: the plotted time, within these limits.
constexpr double kMinHistoryS = 10.0;
constexpr double kMaxHistoryS = 120.0;
constexpr double kSameSpeed = 1e-9;  // relative: a smaller difference is a rounding error

constexpr float kButtonEms = 4.6F;
constexpr float kToStartEms = 5.2F;
constexpr float kSpeedEms = 3.6F;
constexpr float kBackEms = 9.0F;
constexpr float kFileNameEms = 12.0F;
constexpr const char* kSpeedField = "##speed";
constexpr float kTrackEms = 0.5F;     // how thick the track is
constexpr float kSliderEms = 1.5F;    // how high all of it is
constexpr float kNearMarkEms = 0.4F;  // a click so near to a mark is one on it
constexpr double kQuietOpeningS = 0.3;

double time_of(const ReplaySession& replay, const file::Mark& mark) {
  return static_cast<double>(mark.tick) / replay.recording().rate_hz;
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void draw_play(const PanelContext& context) {
  if (button(context.snapshot.paused ? "Play###pause" : "Pause###pause",
             "Plays or pauses the recording (key P). At the end it starts again.",
             {.width = ems(kButtonEms)}))
    toggle_pause(context);
}

void draw_replay_step(const PanelContext& context) {
  if (button("Step###step", "The next row, while paused (key S or →); ← goes back to the last one",
             {.width = ems(kButtonEms), .enabled = context.snapshot.paused}))
    single_step(context);
}

void draw_to_start(const PanelContext& context) {
  if (button("To start###reset", "To the first row (key R)", {.width = ems(kToStartEms)}))
    reset_session(context);
}

std::string replay_time_text(const ReplaySession& replay, double time_s) {
  return fmt::format("{:8.3f} / {:.3f} s", time_s, replay.end_s());
}

float replay_time_width(const PanelContext& context, const ReplaySession& replay) {
  const draw::FontScope font(context.theme.fonts.digits, 0.0F);
  return ImGui::CalcTextSize(replay_time_text(replay, replay.end_s()).c_str()).x;
}

void draw_time(const PanelContext& context, ReplaySession& replay) {
  ImGui::PushFont(context.theme.fonts.digits, 0.0F);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(replay_time_text(replay, replay.position_s()).c_str());
  ImGui::PopFont();
  explain(
      fmt::format("Time of the session that was recorded. This recording goes from {:.3f} s to "
                  "{:.3f} s.",
                  replay.begin_s(), replay.end_s()));
}

void set_speed(const PanelContext& context, ReplaySession& replay, double speed) {
  if (speed >= kMinReplaySpeed && speed <= kMaxReplaySpeed) {
    replay.set_speed(speed);
    return;
  }
  refuse(context, kSpeedField,
         fmt::format("{} is out of range; it takes {:g} to {:g}", rounded_number(speed),
                     kMinReplaySpeed, kMaxReplaySpeed));
}

void draw_speed(const PanelContext& context, ReplaySession& replay) {
  constexpr const char* kTooltip =
      "Speed in recorded seconds per second, 0.01 to 100 (keys [ and ])";
  ImGui::SetNextItemWidth(ems(kSpeedEms));
  if (const auto typed = number_field(context, kSpeedField, replay.speed()))
    set_speed(context, replay, *typed);
  explain(kTooltip);
  ImGui::SameLine(0.0F, 1.0F);
  if (ImGui::BeginCombo("##speeds", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_HeightLarge)) {
    for (const double speed : kSpeeds) {
      if (list_choice(fmt::format("{0:g}x###speed {0:g}x", speed),
                      std::abs(speed - replay.speed()) < kSameSpeed * speed))
        replay.set_speed(speed);
    }
    ImGui::EndCombo();
  }
  explain(kTooltip);
}

void draw_replay_repeat(const PanelContext& context, ReplaySession& replay) {
  const bool loops = replay.loops();
  if (choice_button(context, "Repeat###repeat", loops, "Begins anew at the end (key L)",
                    {.width = ems(kButtonEms)}))
    replay.set_loop(!loops);
}

void draw_replay_end(const PanelContext& context) {
  if (button("Back to the scene###back to the scene",
             "Ends the replay and starts the scene that ran before, at rest.",
             {.width = ems(kBackEms)}))
    context.replay.wants_back = true;
}

// A long name is clipped; the tooltip has its path.
void draw_file_name(const PanelContext& context, const ReplaySession& replay) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(
      corner, ImVec2(corner.x + ems(kFileNameEms), corner.y + ImGui::GetFrameHeight()), true);
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(context.theme.colour(draw::Tone::kAccent), "%s",
                     file_name(replay.recording().csv_path).c_str());
  ImGui::PopClipRect();
  explain(replay.recording().csv_path);
}

// The mark at this pixel, or null.
const file::Mark* mark_at(const ReplaySession& replay, std::span<const file::Mark> marks,
                          float pixel, const ImVec2& corner, float width) {
  const double duration_s = std::max(replay.duration_s(), 1e-9);
  const file::Mark* nearest = nullptr;
  float distance = ems(kNearMarkEms);
  for (const file::Mark& mark : marks) {
    const double share = (time_of(replay, mark) - replay.begin_s()) / duration_s;
    const float away = std::abs(corner.x + static_cast<float>(share) * width - pixel);
    if (away > distance) continue;
    distance = away;
    nearest = &mark;
  }
  return nearest;
}

void draw_track(const PanelContext& context, ReplaySession& replay, const ImVec2& corner,
                const ImVec2& size) {
  const double duration_s = std::max(replay.duration_s(), 1e-9);
  const auto x_of = [&](double time_s) {
    return corner.x + static_cast<float>((time_s - replay.begin_s()) / duration_s) * size.x;
  };
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float middle = corner.y + 0.5F * size.y;
  const float half = 0.5F * ems(kTrackEms);
  const float now = x_of(replay.position_s());
  list->AddRectFilled(ImVec2(corner.x, middle - half), ImVec2(corner.x + size.x, middle + half),
                      context.theme.packed(draw::Tone::kFaint), half);
  list->AddRectFilled(ImVec2(corner.x, middle - half), ImVec2(now, middle + half),
                      context.theme.packed(draw::Tone::kAccent, 0.55F), half);
  for (const file::Mark& mark : replay.marks()) {
    const float x = x_of(time_of(replay, mark));
    list->AddLine(ImVec2(x, corner.y), ImVec2(x, corner.y + size.y),
                  context.theme.packed(draw::Tone::kWarning), std::max(1.0F, ems(0.12F)));
  }
  list->AddCircleFilled(ImVec2(now, middle), ems(0.55F), context.theme.packed(draw::Tone::kAccent));
}

// The time slider of the recording; a click on a mark goes to it.
void draw_slider(const PanelContext& context, ReplaySession& replay) {
  const float inset = ems(0.55F);
  const ImVec2 outer = ImGui::GetCursorScreenPos();
  const ImVec2 corner(outer.x + inset, outer.y);
  const ImVec2 size(std::max(1.0F, ImGui::GetContentRegionAvail().x - 2.0F * inset),
                    ems(kSliderEms));
  ImGui::InvisibleButton("##time slider", ImVec2(size.x + 2.0F * inset, size.y));
  const ImGuiIO& io = ImGui::GetIO();
  const double share =
      std::clamp(static_cast<double>((io.MousePos.x - corner.x) / size.x), 0.0, 1.0);
  const double pointed_s = replay.begin_s() + share * replay.duration_s();
  const file::Mark* mark = ImGui::IsItemHovered()
                               ? mark_at(replay, replay.marks(), io.MousePos.x, corner, size.x)
                               : nullptr;
  const bool moved = io.MouseDelta.x != 0.0F;
  if (ImGui::IsItemActivated()) {
    go_to(context, replay, mark != nullptr ? time_of(replay, *mark) : pointed_s);
  } else if (ImGui::IsItemActive() && moved) {
    go_to(context, replay, pointed_s);
  }
  draw_track(context, replay, corner, size);
  if (!ImGui::IsItemHovered()) return;
  if (mark != nullptr) {
    ImGui::SetTooltip("%.3f s  %s", time_of(replay, *mark), mark->text.c_str());
  } else {
    ImGui::SetTooltip("%.3f s", pointed_s);
  }
}

}  // namespace

double slower_than(double speed) {
  const auto above = std::find_if(kSpeeds.begin(), kSpeeds.end(), [speed](double usual) {
    return usual >= speed * (1.0 - kSameSpeed);
  });
  return above == kSpeeds.begin() ? kSpeeds.front() : *(above - 1);
}

double faster_than(double speed) {
  const auto above = std::find_if(kSpeeds.begin(), kSpeeds.end(), [speed](double usual) {
    return usual > speed * (1.0 + kSameSpeed);
  });
  return above == kSpeeds.end() ? kSpeeds.back() : *above;
}

void draw_replay_bar(const PanelContext& context, ReplaySession& replay) {
  const float speed = ems(kSpeedEms) + 1.0F + ImGui::GetFrameHeight();
  const std::array<RowControl, 8> controls{
      {{ems(kButtonEms), 0, [&] { draw_play(context); }},
       {ems(kButtonEms), 4, [&] { draw_replay_step(context); }},
       {ems(kToStartEms), 5, [&] { draw_to_start(context); }},
       {replay_time_width(context, replay), 1, [&] { draw_time(context, replay); }},
       {speed, 3, [&] { draw_speed(context, replay); }, kSpeedField},
       {ems(kButtonEms), 6, [&] { draw_replay_repeat(context, replay); }},
       {ems(kBackEms), 2, [&] { draw_replay_end(context); }},
       {ems(kFileNameEms), 7, [&] { draw_file_name(context, replay); }}}};
  draw_overflow_row(context, "replay", controls);
  draw_slider(context, replay);
}

void draw_opening(const PanelContext& context) {
  ReplayState& state = context.replay;
  if (!state.opening.running() || state.opening_s < kQuietOpeningS) return;
  ImGui::AlignTextToFramePadding();
  ImGui::Text("reading %s  %.0f %%", file_name(state.opening_path).c_str(),
              100.0 * state.opening.fraction());
  ImGui::SameLine();
  if (button("Cancel###cancel opening", "The present session or recording continues."))
    state.opening.give_up();
}

void go_to(const PanelContext& context, ReplaySession& replay, double time_s) {
  replay.set_history(std::clamp(context.time.window_s, kMinHistoryS, kMaxHistoryS));
  replay.seek(time_s);
  context.time.follow = true;
}

void slower(const PanelContext& context) {
  ReplaySession* replay = context.shows.replay;
  if (replay == nullptr) return change_slow_motion(context, 1);
  replay->set_speed(slower_than(replay->speed()));
}

void faster(const PanelContext& context) {
  ReplaySession* replay = context.shows.replay;
  if (replay == nullptr) return change_slow_motion(context, -1);
  replay->set_speed(faster_than(replay->speed()));
}

void toggle_loop(const PanelContext& context) {
  if (ReplaySession* replay = context.shows.replay) replay->set_loop(!replay->loops());
}

void step_back(const PanelContext& context) {
  ReplaySession* replay = context.shows.replay;
  if (replay == nullptr || !context.snapshot.paused) return;
  const auto tick = static_cast<double>(context.snapshot.newest.x().tick);
  go_to(context, *replay, (tick - 1.0) / replay->recording().rate_hz);
}

void previous_mark(const PanelContext& context) {
  ReplaySession* replay = context.shows.replay;
  if (replay == nullptr) return;
  const auto marks = replay->marks();
  const auto from =
      std::ranges::lower_bound(marks, context.snapshot.newest.x().tick, {}, &file::Mark::tick);
  if (from != marks.begin()) go_to(context, *replay, time_of(*replay, *(from - 1)));
}

void next_mark(const PanelContext& context) {
  ReplaySession* replay = context.shows.replay;
  if (replay == nullptr) return;
  const auto marks = replay->marks();
  const auto next =
      std::ranges::upper_bound(marks, context.snapshot.newest.x().tick, {}, &file::Mark::tick);
  if (next != marks.end()) go_to(context, *replay, time_of(*replay, *next));
}

}  // namespace hapticwall::ui
