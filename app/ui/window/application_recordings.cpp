// How a recording takes the place of the session, and the scene that of a recording.
#include <algorithm>
#include <string>
#include <utility>

#include "app/ui/application.h"
#include "app/ui/comparing.h"
#include "app/ui/recent_files.h"
#include "app/ui/replay_panel.h"
#include "app/ui/replay_state.h"

namespace hapticwall::ui {
namespace {

Result<std::unique_ptr<runtime::Session>> open_replay(const std::string& csv_path,
                                                      const file::ReadProgress& progress) {
  auto replay = runtime::start_replay(csv_path, {}, progress);
  if (!replay) return replay.error();
  return std::unique_ptr<runtime::Session>(std::move(*replay));
}

}  // namespace

// The session goes on while the file is read: of a device, too, whose force can be taken away.
void Application::open_wanted_recording() {
  std::string path = std::exchange(state_.transient.wanted_recording, {});
  if (path.empty()) return;
  state_.replay.opening_s = 0.0;
  state_.replay.opening_path = path;
  const RecordingOpener open = sessions_.open_recording ? sessions_.open_recording : open_replay;
  state_.replay.opening.start(
      [open, path = std::move(path)](const auto& progress) { return open(path, progress); });
}

void Application::take_opened_recording() {
  ReplayState& replay = state_.replay;
  if (replay.opening.running()) {
    replay.opening_s += static_cast<double>(ImGui::GetIO().DeltaTime);
  }
  auto opened = replay.opening.take();
  if (!opened) return;
  if (!*opened) {
    tell(state_, MessageKind::kProblem, opened->error().message);
    std::erase(state_.persisted.recent, replay.opening_path);
    return;
  }
  if (replay_of(*session_) == nullptr) {
    before_ = Before{session_->scene(), state_.transient.loaded_scene};
    end_live_session();
  }
  show_recording(std::move(**opened));
}

// Without force first; then what is still to be written may take its time.
void Application::end_live_session() {
  session_->arm(false);
  if (session_->recording_status().state != runtime::RecordingState::kRecording) return;
  const Failure failure = session_->stop_recording();
  tell(state_, failure ? MessageKind::kProblem : MessageKind::kNote,
       failure ? failure->message : "recording finished: " + session_->recording_status().path);
}

void Application::show_recording(std::unique_ptr<runtime::Session> session) {
  session_ = std::move(session);
  forget_session();
  begin_comparison(state_, session_->scene(), slots_of(state_));
  runtime::ReplaySession* replay = replay_of(*session_);
  state_.transient.loaded_scene = session_->scene();
  jumps_ = session_->snapshot().resets;
  if (replay == nullptr) return;
  state_.transient.loaded_scene = replay->recording().loaded.scene;
  if (const runtime::Overlay* overlay = replay->overlay())
    draw_overlay_in_plots(state_, overlay, history_of(*overlay));
}

void Application::go_back() {
  if (runtime::ReplaySession* replay = replay_of(*session_)) notice_rerun(state_, *replay);
  if (!std::exchange(state_.replay.wants_back, false) || !before_) return;
  WantedScene wanted{before_->scene};
  wanted.back_to = std::make_shared<const Scene>(before_->loaded);
  state_.transient.wanted_scene = std::move(wanted);
}

// A jump forwards would else be a line across what was jumped over.
void Application::notice_jumps() {
  if (replay_of(*session_) == nullptr) return;
  const std::uint32_t jumps = session_->snapshot().resets;
  if (std::exchange(jumps_, jumps) == jumps) return;
  history_.clear();
  y_history_.clear();
}

// Nobody knows the true place of a real handle, nor of one that was recorded.
bool Application::measured() const { return !knows_truth(*session_); }

}  // namespace hapticwall::ui
