#include "app/ui/window/application.h"

#include <imgui_internal.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/ui/panel/replay_panel.h"
#include "app/ui/state/appearance.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/recent_files.h"
#include "app/ui/state/recording_wishes.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/window/keys.h"
#include "app/ui/window/window_layout.h"

namespace hapticwall::ui {
namespace {

constexpr std::size_t kTicksAtATime = 4096;
constexpr int kMaxBatches = 64;  // bounds a frame when the loop is faster than the window

// The true place of a real handle is unknown.
void draw_where_measured(Tick& tick) {
  for (Sample& sample : tick.in_use()) {
    sample.truth.position_m = sample.position_m;
    sample.truth.velocity_m_per_s = sample.velocity_m_per_s;
    sample.truth.hand_path_m = sample.position_m;
  }
}

}  // namespace

Result<std::unique_ptr<Application>> Application::create(const Scene& scene, const Options& options,
                                                         const draw::Theme& theme,
                                                         Sessions sessions) {
  Result<std::unique_ptr<WallRenderer>> renderer = WallRenderer::create();
  if (!renderer) return renderer.error();
  std::unique_ptr<Application> application(
      new Application(std::move(sessions), std::move(*renderer), theme, options));
  if (Failure failure = application->start_first(scene)) return *std::move(failure);
  if (options.experiment) {
    if (Failure failure = start_experiment(application->state_.compare, application->state_.dock,
                                           application->state_.toasts, application->live_->scene(),
                                           options.experiment))
      return *std::move(failure);
  }
  return application;
}

Application::Application(Sessions sessions, std::unique_ptr<WallRenderer> renderer,
                         const draw::Theme& theme, const Options& options)
    : sessions_(std::move(sessions)),
      renderer_(std::move(renderer)),
      other_renderer_(renderer_->another()),
      theme_(theme),
      settings_(options.settings_path),
      now_s_(options.now_s),
      incoming_(kTicksAtATime),
      sound_(sessions_.open_card ? sessions_.open_card : sound::open_usual_card) {
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_DockingEnable;
  io.ConfigWindowsMoveFromTitleBarOnly = true;  // the views and plots are dragged, too
  state_.window.settings_path = options.settings_path;
  state_.appearance.forced_scale = options.forced_scale;
  settings_.load(state_);
  state_.can = options.can;
  state_.sound.available = state_.can.sound && (sessions_.open_card || sound::may_have_card());
  RecordingWishes& recording = state_.recording;
  recording.records_signals = options.records_signals || recording.chosen_signals;
  recording.folder =
      options.recording_folder.empty() ? recording.chosen_folder : options.recording_folder;
  if (!options.opened_file.empty()) remember_recent(state_.scene.recent, options.opened_file);
}

void Application::compare_slots(const CompareSlots& slots) {
  begin_comparison(state_.compare, state_.plots, state_.toasts, session().scene(), slots);
}

Failure Application::start_first(const Scene& scene) {
  if (sessions_.replay) {
    before_ = Before{scene, scene};
    replay_ = sessions_.replay();
    compare_slots(slots_for(replay_->scene()));
    show_recording(std::move(replay_));
    return std::nullopt;
  }
  if (Failure failure = start_session(scene)) return failure;
  state_.scene.loaded = live_->scene();
  compare_slots(slots_for(live_->scene()));
  notice_changes(state_.scene, state_.compare, live_->scene());
  return std::nullopt;
}

// Starts a session on the device, if there is one. A failure changes nothing.
Failure Application::start_session(const Scene& scene,
                                   std::shared_ptr<BorrowedAlgorithm> borrowed) {
  auto started = sessions_.start_on_device ? sessions_.start_on_device(scene, borrowed.get())
                                           : sessions_.simulate(scene, borrowed.get());
  if (!started) return started.error();
  live_ = std::move(*started);  // ends the loop before
  borrowed_ = std::move(borrowed);
  return std::nullopt;
}

void Application::take_ticks() {
  const bool measured = !session().knows_truth();
  samples_came_ = false;
  notice_jumps();
  history_.set_counts(session().scene());
  history_.name_signals(session().signals());
  for (int batch = 0; batch < kMaxBatches; ++batch) {
    const std::span<Tick> ticks = std::span(incoming_).first(session().take_ticks(incoming_));
    if (measured) std::ranges::for_each(ticks, draw_where_measured);
    if (state_.identify.experiment) {
      for (const Tick& tick : ticks) state_.identify.experiment->add(tick);
    }
    history_.push(ticks);
    note_ticks(state_.compare, session().scene(), ticks);
    follow_with_other_wall(ticks);
    samples_came_ = samples_came_ || !ticks.empty();
    if (ticks.size() < incoming_.size()) break;
  }
}

// The other wall has the algorithm of the slot that is not in force.
void Application::follow_with_other_wall(std::span<const Tick> ticks) {
  const CompareSlots slots = slots_of(state_.compare);
  const bool alone = !live_ || borrowed_ || blind_test_runs(state_.compare);
  if (alone) return state_.first.other.forget();
  state_.first.other.follow(*live_, live_->generation(), slots.of(compare::other(slots.active)),
                            ticks);
}

void Application::frame() {
  state_.input.now_s = now_s_ ? now_s_() : ImGui::GetTime();
  keep_appearance();
  take_ticks();
  heed_plugins();
  session::Snapshot snapshot = session().snapshot();
  if (!session().knows_truth()) draw_where_measured(snapshot.newest);
  note_loop(snapshot);
  // At rest only the timing page shows the timing, so that the window need not be painted again.
  if (!snapshot.paused || state_.timing.page_seen)
    note_timing(state_.timing, live_.get(), snapshot.timing);
  look_at_moment(snapshot);
  const PanelContext context =
      context_of(state_, session(), snapshot, theme_, visibility(snapshot.generation));
  heed_feed(context);
  handle_keys(context, bindings_in_force(context.shows));
  const PageParts page{context,         history_.axis(context.shows.axis == Axis::kY ? 1 : 0),
                       *renderer_,      state_.map,
                       state_.all_runs, state_.studies};
  draw_window({page, *other_renderer_, state_.first});
  // Last, because the panels hold references to the session that this replaces.
  heed_identify(snapshot);
  go_back();
  repeat(snapshot);
  start_wanted_scene();
  open_wanted_recording();
  take_opened_recording();
  if (live_ && !state_.identify.experiment)
    notice_changes(state_.scene, state_.compare, live_->scene());
  heed_sound(snapshot);
  state_.input.pointer_events.clear();
  if (ImGui::GetCurrentContext()->InputEventsQueue.empty()) state_.input.key_presses.clear();
  settings_.pass(state_, static_cast<double>(ImGui::GetIO().DeltaTime));
}

// A loop that gave up reports that itself.
void Application::note_loop(const session::Snapshot& snapshot) {
  const bool runs = live_ && !snapshot.ended_by_fault;
  note_answer(state_.timing.answer, runs ? &snapshot : nullptr,
              session().scene().sampling.period_s(), state_.input.now_s);
}

// The session takes the newest revision of its plug-in, and blends the force into it.
void Application::heed_plugins() {
  for (const file::PluginNews& news : plugins_.look(state_.input.now_s)) {
    state_.toasts.tell(news.loaded ? MessageKind::kNote : MessageKind::kProblem, news.text);
    if (!live_ || !news.loaded) continue;
    const Scene scene = live_->scene();
    static_cast<void>(live_->change_scene(scene));
  }
}

// Slow motion would be chopped.
void Application::heed_sound(const session::Snapshot& snapshot) {
  sound::SoundSource source;
  if (live_ && snapshot.periods_per_tick == 1)
    source = {live_->sound_feed(), live_->scene().sampling.rate_hz, live_->knows_truth()};
  sound_.follow(source);
  sound_.mix({state_.sound.volume, masks_sound(state_.compare)});
  sound_.play(state_.sound.on);
  note_sound();
}

// Without a card, switches the sound off again and gives the reason in one sentence.
void Application::note_sound() {
  SoundChoice& sound = state_.sound;
  sound.status = sound_.status();
  if (sound.status.state == sound::SoundState::kNoCard && std::exchange(sound.on, false))
    state_.toasts.tell(MessageKind::kNote, describe(sound.status));
}

// Shows the newest sample, or the one under the pointer while plots are frozen.
void Application::look_at_moment(session::Snapshot& snapshot) {
  const std::optional<double> looked_at_s = std::exchange(state_.time.looked_at_s, {});
  note_tails(state_.tails, history_, session().scene(), session().knows_truth(), looked_at_s);
  state_.first.other.judge();
  follow_rhythm(state_.time,
                state_.tails.at(state_.selection.axis == Axis::kY ? 1 : 0).frequency_hz);
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const draw::SampleHistory& samples = history_.axis(axis);
    Swept& swept = state_.wall.transient.swept.at(axis);
    if (!looked_at_s || samples.empty()) {
      note_swept(swept, samples);
    } else {
      swept = {};
      snapshot.newest.axes.at(axis) = samples.sample(*samples.nearest(*looked_at_s));
    }
  }
}

Visibility Application::visibility(std::uint32_t echoed_generation) {
  const bool echoed = live_ && echoed_generation == live_->generation();
  if (live_ &&
      (in_force_generation_ == 0 || (echoed && in_force_generation_ != echoed_generation))) {
    in_force_ = live_->scene();
    in_force_generation_ = echoed_generation;
  }
  const bool hides = blind_test_runs(state_.compare);
  const bool second_axis = session().scene().two_axes() && state_.selection.axis == Axis::kY;
  return {live_.get(),
          replay_.get(),
          hides,
          hides,
          second_axis ? Axis::kY : Axis::kX,
          live_ ? &in_force_ : &replay_->scene()};
}

// Colours and scale change only between frames.
void Application::keep_appearance() {
  const float scale = scale_in_force(state_.appearance);
  if (state_.appearance.look == look_ && scale == scale_) return;
  look_ = state_.appearance.look;
  scale_ = scale;
  restyle(theme_, look_, scale_);
}

void Application::note_frame(double frame_s, double now_s) {
  state_.timing.frames.add(frame_s);
  state_.wall.transient.resolution.note_frame(frame_s, now_s);
}

bool Application::moving() const {
  return samples_came_ || state_.timing.answer.silent_s > 0.0 || state_.toasts.moving() ||
         !state_.wall.transient.view_refined || state_.replay.opening.running() ||
         state_.replay.rerun.running() || state_.map.live.running() || state_.all_runs.running() ||
         state_.studies.running() || state_.identify.fit.running() || awaits_trial(state_.compare);
}

void Application::drop(std::span<const std::string> paths) {
  if (!state_.can.files) return;
  // There is one session: of several files the last one is opened.
  for (const std::string& path : paths) open_file(state_.scene, state_.toasts, path);
}

void Application::start_wanted_scene() {
  if (!state_.scene.wanted) return;
  const WantedScene wanted = std::move(*state_.scene.wanted);
  state_.scene.wanted.reset();
  if (const auto problem = validate(wanted.scene)) return tell(state_.toasts, *problem);
  if (!start_anew(wanted.scene)) return;
  state_.replay.opening.give_up();
  forget_session();
  before_.reset();
  compare_slots(slots_after(state_.compare, wanted));
  if (wanted.loaded) {
    state_.scene.loaded = live_->scene();
    state_.scene.switched_off.clear();
  }
  if (wanted.back_to) state_.scene.loaded = *wanted.back_to;
}

// Begins a simulated scene anew, at rest, unless somebody leads it or records it.
void Application::repeat(const session::Snapshot& snapshot) {
  if (!live_ || !state_.scene.repeats || !live_->device_info().is_simulated) return;
  if (snapshot.newest.x().time_s < live_->scene().duration_s || state_.hand.led ||
      live_->recording_status().state == session::RecordingState::kRecording)
    return;
  live_->reset();
}

// Clears the state of the previous session.
void Application::forget_session() {
  state_.scene.repeats = false;
  state_.timing.cleared = {};
  state_.timing.answer = {};
  in_force_generation_ = 0;
  history_.clear();
  state_.first.other.forget();
  state_.edit.refusal.reset();
  state_.hand.drag.lead.release();
  state_.hand.led = false;
  state_.recording.mark_text.clear();
  state_.time.follow = true;
  state_.replay.rerun.give_up();
  draw_overlay_in_plots(state_.plots, nullptr, nullptr);
}

// A replay holds no device, so that it stays when the scene does not start. There is one device, so
// that its session ends before the next one starts; if that fails, the simulator takes over, with a
// message. Returns false when the old session or replay stays.
bool Application::start_anew(const Scene& scene,
                             const std::shared_ptr<BorrowedAlgorithm>& borrowed) {
  const bool on_device = live_ && !live_->device_info().is_simulated;
  if (on_device) live_.reset();
  Failure failure = start_session(scene, borrowed);
  if (on_device && failure) {
    sessions_.start_on_device = nullptr;
    state_.toasts.tell(
        MessageKind::kProblem,
        failure->message + "; this is the simulator now: start the program again for the device");
    failure = start_session(scene);
    if (failure) throw std::runtime_error(failure->message);  // no session is left to show
  }
  if (failure) {
    tell(state_.toasts, *failure);
    return false;
  }
  replay_.reset();
  return true;
}

}  // namespace hapticwall::ui
