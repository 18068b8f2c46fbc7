// Changes between a live session and a recording.
#include <algorithm>
#include <string>
#include <utility>

#include "app/ui/panel/replay_panel.h"
#include "app/ui/panel/replay_state.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/window/application.h"

namespace hapticwall::ui {
namespace {

Result<std::unique_ptr<session::ReplaySession>> open_replay(const std::string& csv_path,
                                                            const file::ReadProgress& progress) {
  return session::start_replay(csv_path, {}, progress);
}

}  // namespace

// The session continues while the file is read, so that the force of a device can still be removed.
void Application::open_wanted_recording() {
  std::string path = std::exchange(state_.scene.wanted_recording, {});
  if (path.empty()) return;
  state_.replay.opening_s = 0.0;
  state_.replay.opening_path = path;
  const RecordingOpener open = sessions_.open_recording ? sessions_.open_recording : open_replay;
  state_.replay.opening.start(
      [open, path = std::move(path)](const auto& progress) { return open(path, progress); });
}

void Application::take_opened_recording() {
  ReplayState& replay = state_.replay;
  if (replay.opening.running()) replay.opening_s += static_cast<double>(ImGui::GetIO().DeltaTime);
  auto opened = replay.opening.take();
  if (!opened) return;
  if (!*opened) {
    tell(state_.toasts, opened->error());
    std::erase(state_.scene.recent, replay.opening_path);
    return;
  }
  if (live_) {
    before_ = Before{live_->scene(), state_.scene.loaded};
    end_live_session();
  }
  show_recording(std::move(**opened));
}

// Removes the force first; writing the rest may take time.
void Application::end_live_session() {
  live_->arm(false);
  if (live_->recording_status().state == session::RecordingState::kRecording)
    stop_recording(state_.toasts, *live_);
}

void Application::show_recording(std::unique_ptr<session::ReplaySession> replay) {
  live_.reset();
  replay_ = std::move(replay);
  forget_session();
  compare_slots(slots_of(state_.compare));
  jumps_ = replay_->snapshot().resets;
  state_.scene.loaded = replay_->recording().loaded.scene;
  if (const session::Overlay* overlay = replay_->overlay())
    draw_overlay_in_plots(state_.plots, overlay, history_of(*overlay, replay_->scene().x().device));
}

void Application::go_back() {
  if (replay_) notice_rerun(state_.replay, state_.plots, state_.toasts, *replay_);
  if (!std::exchange(state_.replay.wants_back, false) || !before_) return;
  WantedScene wanted{before_->scene};
  wanted.back_to = std::make_shared<const Scene>(before_->loaded);
  state_.scene.wanted = std::move(wanted);
}

// Prevents a line across a forward jump.
void Application::notice_jumps() {
  if (!replay_) return;
  const std::uint32_t jumps = replay_->snapshot().resets;
  if (std::exchange(jumps_, jumps) == jumps) return;
  history_.clear();
}

}  // namespace hapticwall::ui
