#include "app/ui/application.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/ui/appearance.h"
#include "app/ui/comparing.h"
#include "app/ui/keys.h"
#include "app/ui/recent_files.h"
#include "app/ui/replay_panel.h"
#include "app/ui/replay_state.h"
#include "app/ui/shown_axis.h"
#include "app/ui/undo_controls.h"
#include "app/ui/window_layout.h"

namespace hapticwall::ui {
namespace {

constexpr std::size_t kSamplesAtATime = 4096;
constexpr int kMostBatches = 64;  // a frame ends even where the loop were faster than we are

// Nobody knows the true place of a real handle.
void draw_where_measured(Sample& sample) {
  sample.truth.position_m = sample.position_m;
  sample.truth.velocity_m_per_s = sample.velocity_m_per_s;
  sample.truth.hand_path_m = sample.position_m;
}

}  // namespace

Result<std::unique_ptr<Application>> Application::create(const Scene& scene, const Options& options,
                                                         const Theme& theme, Sessions sessions) {
  Result<std::unique_ptr<WallRenderer>> renderer = WallRenderer::create();
  if (!renderer) return renderer.error();
  Result<std::unique_ptr<runtime::Session>> session = sessions.first ? sessions.first()
                                                      : sessions.start_on_device
                                                          ? sessions.start_on_device(scene)
                                                          : sessions.simulate(scene);
  if (!session) return session.error();
  std::unique_ptr<Application> application(new Application(std::move(sessions), std::move(*session),
                                                           std::move(*renderer), theme, options));
  if (replay_of(*application->session_) != nullptr) {
    application->before_ = Before{scene, scene};
    application->show_recording(std::move(application->session_));
  }
  return application;
}

Application::Application(Sessions sessions, std::unique_ptr<runtime::Session> session,
                         std::unique_ptr<WallRenderer> renderer, const Theme& theme,
                         const Options& options)
    : sessions_(std::move(sessions)),
      session_(std::move(session)),
      renderer_(std::move(renderer)),
      theme_(theme),
      settings_(options.settings_path),
      history_(kHistoryCapacity),
      y_history_(kHistoryCapacity),
      incoming_(kSamplesAtATime),
      incoming_y_(kSamplesAtATime) {
  TransientState& transient = state_.transient;
  transient.loaded_scene = session_->scene();
  transient.settings_path = options.settings_path;
  transient.forced_scale = options.forced_scale;
  settings_.load(state_);
  transient.recording_folder = options.recording_folder.empty() ? state_.persisted.recording_folder
                                                                : options.recording_folder;
  if (!options.opened_file.empty()) remember_recent(state_.persisted.recent, options.opened_file);
  begin_comparison(state_, session_->scene(), slots_for(session_->scene()));
  if (replay_of(*session_) == nullptr) notice_changes(state_, session_->scene());
}

void Application::take_samples() {
  const bool measured = this->measured();
  samples_came_ = false;
  notice_jumps();
  for (int batch = 0; batch < kMostBatches; ++batch) {
    const std::size_t count = session_->take_samples(incoming_);
    if (measured) {
      for (Sample& sample : std::span(incoming_).first(count)) draw_where_measured(sample);
    }
    history_.push(std::span<const Sample>(incoming_).first(count));
    const std::size_t y_count = session_->take_second_axis(std::span(incoming_y_).first(count));
    if (measured) {
      for (Sample& sample : std::span(incoming_y_).first(y_count)) draw_where_measured(sample);
    }
    y_history_.push(std::span<const Sample>(incoming_y_).first(y_count));
    note_samples(state_, session_->scene(), std::span<const Sample>(incoming_).first(count));
    samples_came_ = samples_came_ || count > 0;
    if (count < incoming_.size()) break;
  }
}

void Application::frame() {
  keep_appearance();
  take_samples();
  runtime::Snapshot snapshot = session_->snapshot();
  if (measured()) {
    draw_where_measured(snapshot.sample);
    draw_where_measured(snapshot.y);
  }
  note_timing(state_.timing, *session_, snapshot.timing);
  const PanelContext context{*session_, snapshot, theme_, state_};
  state_.transient.items.clear();
  handle_keys(context, bindings_in_force(state_));
  draw_window(context, shows_second_axis(context) ? y_history_ : history_, *renderer_);
  // Last: the panels hold references to the session that this replaces.
  go_back();
  start_wanted_scene();
  open_wanted_recording();
  take_opened_recording();
  if (replay_of(*session_) == nullptr) notice_changes(state_, session_->scene());
  settings_.pass(state_, static_cast<double>(ImGui::GetIO().DeltaTime));
}

// Colours and scale change between two frames only.
void Application::keep_appearance() {
  const float scale = scale_in_force(state_);
  if (state_.persisted.look == look_ && scale == scale_) return;
  look_ = state_.persisted.look;
  scale_ = scale;
  restyle(theme_, look_, scale_);
}

bool Application::moving() const {
  return samples_came_ || state_.transient.toasts.moving() || !state_.wall.transient.view_refined ||
         state_.replay.opening.running() || state_.replay.rerun.running();
}

void Application::drop(std::span<const std::string> paths) {
  // One session runs: of many files the last one is opened.
  for (const std::string& path : paths) open_file(state_, path);
}

void Application::start_wanted_scene() {
  if (!state_.transient.wanted_scene) return;
  const WantedScene wanted = std::move(*state_.transient.wanted_scene);
  state_.transient.wanted_scene.reset();
  if (const auto problem = validate(wanted.scene)) {
    tell(state_, *problem);
    return;
  }
  if (!start_anew(wanted.scene)) return;
  state_.replay.opening.give_up();
  forget_session();
  before_.reset();
  begin_comparison(state_, session_->scene(), slots_after(state_, wanted));
  if (wanted.loaded) {
    state_.transient.loaded_scene = session_->scene();
    state_.transient.switched_off.clear();
  }
  if (wanted.back_to) state_.transient.loaded_scene = *wanted.back_to;
}

// What belongs to the session that was.
void Application::forget_session() {
  state_.timing.cleared = {};
  history_ = SampleHistory(kHistoryCapacity);
  y_history_ = SampleHistory(kHistoryCapacity);
  state_.transient.refusal.reset();
  state_.transient.hand_m.reset();
  state_.transient.dragging_hand = false;
  state_.transient.mark_text.clear();
  state_.transient.follow = true;
  state_.replay.rerun.give_up();
  draw_overlay_in_plots(state_, nullptr, nullptr);
}

// A replay takes the device from nobody: it stays where the scene does not start.
bool Application::start_beside_replay(const Scene& scene) {
  Result<std::unique_ptr<runtime::Session>> started =
      sessions_.start_on_device ? sessions_.start_on_device(scene) : sessions_.simulate(scene);
  if (!started) {
    tell(state_, MessageKind::kProblem, started.error().message);
    return false;
  }
  session_ = std::move(*started);
  return true;
}

// There is one device: the session that has it ends before the next one begins. Where the next one
// cannot, the window goes on with the simulator and says so. False: the session is the old one.
bool Application::start_anew(const Scene& scene) {
  if (replay_of(*session_) != nullptr) return start_beside_replay(scene);
  const bool on_device = !session_->device_info().is_simulated;
  if (on_device) {
    const SessionStarter starter = std::exchange(sessions_.start_on_device, nullptr);
    session_.reset();
    Result<std::unique_ptr<runtime::Session>> started = starter(scene);
    if (started) {
      session_ = std::move(*started);
      sessions_.start_on_device = starter;
      return true;
    }
    tell(state_, MessageKind::kProblem,
         started.error().message +
             "; this is the simulator now: start the program again for the device");
  }
  Result<std::unique_ptr<runtime::Session>> started = sessions_.simulate(scene);
  if (!started) {
    if (on_device) throw std::runtime_error(started.error().message);  // nothing is left to show
    tell(state_, MessageKind::kProblem, started.error().message);
    return false;
  }
  session_ = std::move(*started);
  return true;
}

}  // namespace hapticwall::ui
