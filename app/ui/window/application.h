// Content of the window: owns the session and the state of the panels, and draws frames.
// Independent of GLFW.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/draw/plot/sample_history.h"
#include "app/draw/plot/theme.h"
#include "app/file/plugin/plugin_watch.h"
#include "app/file/recording/recording_reader.h"
#include "app/session/live_session.h"
#include "app/sound/live/sound_player.h"
#include "app/ui/state/frame_input.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/wall/wall_renderer.h"
#include "app/ui/window/paint_gate.h"
#include "app/ui/window/settings_file.h"
#include "app/ui/window/ui_state.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::ui {

class Application {
 public:
  using SessionStarter = session::StartSession;
  // Called on its own thread, because a large recording takes long to read.
  using RecordingOpener = std::function<Result<std::unique_ptr<session::ReplaySession>>(
      const std::string& csv_path, const file::ReadProgress& progress)>;
  struct Sessions {
    SessionStarter simulate;
    SessionStarter start_on_device;  // empty: everything is simulated
    RecordingOpener open_recording;  // empty: session::start_replay()
    // Makes the recording to show first, with the scene to go back to. Empty: a session of the
    // scene.
    std::function<std::unique_ptr<session::ReplaySession>()> replay;
    sound::OpenCard open_card;  // empty: the usual sound card
  };

  // Options besides the scene.
  struct Options {
    std::string settings_path;          // empty: settings are neither read nor kept
    std::string recording_folder;       // folder; empty: the one of the settings
    std::optional<float> forced_scale;  // empty: the settings, or the screen
    std::string opened_file;            // file of the scene; empty: built in
    std::function<double()> now_s;      // clock of pointer events; empty: that of Dear ImGui
    std::shared_ptr<session::Experiment> experiment = nullptr;  // begins at once; null: none
    bool records_signals = false;  // true: records signals even if the settings do not
    Capabilities can{};
  };

  // Needs current contexts of OpenGL 3.3, ImGui and ImPlot for its whole life. Starts a session, on
  // the device if there is one.
  [[nodiscard]] static Result<std::unique_ptr<Application>> create(const Scene& scene,
                                                                   const Options& options,
                                                                   const draw::Theme& theme,
                                                                   Sessions sessions);

  // Draws one frame, between ImGui::NewFrame() and ImGui::Render(); never waits for the loop.
  void frame();

  // Takes samples without drawing, for a minimised window.
  void take_ticks();

  // Scale of the screen; 1 is the designed size.
  void set_screen_scale(float scale) { state_.appearance.screen_scale = scale; }

  // The pointer came here; takes effect in the next frame.
  void point(const PointerEvent& event) { state_.input.pointer_events.push_back(event); }

  // A key was pressed with these modifiers; its event is in the queue of Dear ImGui.
  void press(const KeyPress& press) { state_.input.key_presses.push_back(press); }

  // Files dropped on the window: scenes or recordings.
  void drop(std::span<const std::string> paths);

  // Call it after ImGui::Render(). False: the window shows this frame already.
  [[nodiscard]] bool needs_painting() {
    return paint_gate_.needs_painting(*ImGui::GetDrawData(),
                                      renderer_->times_drawn() + other_renderer_->times_drawn());
  }
  void forget_painted() { paint_gate_.forget(); }

  // The last frame took this long to draw and ended at `now_s`.
  void note_frame(double frame_s, double now_s);
  // True while samples arrive or something is animated.
  [[nodiscard]] bool moving() const;
  // Writes changed settings.
  void save_settings() { settings_.save(state_); }

  [[nodiscard]] session::SampleSource& session() {
    if (live_) return *live_;
    return *replay_;
  }
  // Exactly one of the two is null.
  [[nodiscard]] session::LiveSession* live() { return live_.get(); }
  [[nodiscard]] session::ReplaySession* replay() { return replay_.get(); }
  [[nodiscard]] UiState& state() { return state_; }
  [[nodiscard]] const draw::SampleHistory& history() const { return history_.axis(0); }
  [[nodiscard]] const WallRenderer& renderer() const { return *renderer_; }

 private:
  Application(Sessions sessions, std::unique_ptr<WallRenderer> renderer, const draw::Theme& theme,
              const Options& options);

  [[nodiscard]] Failure start_first(const Scene& scene);
  [[nodiscard]] Failure start_session(const Scene& scene,
                                      std::shared_ptr<BorrowedAlgorithm> borrowed = nullptr);

  // Starts the comparison of the present session.
  void compare_slots(const CompareSlots& slots);
  void follow_with_other_wall(std::span<const Tick> ticks);
  void keep_appearance();
  void heed_plugins();
  void note_loop(const session::Snapshot& snapshot);
  void heed_sound(const session::Snapshot& snapshot);
  void note_sound();
  [[nodiscard]] Visibility visibility(std::uint32_t echoed_generation);
  void look_at_moment(session::Snapshot& snapshot);
  void repeat(const session::Snapshot& snapshot);
  void start_wanted_scene();
  [[nodiscard]] bool start_anew(const Scene& scene,
                                const std::shared_ptr<BorrowedAlgorithm>& borrowed = nullptr);
  void forget_session();

  // application_identify.cpp
  void heed_identify(const session::Snapshot& snapshot);
  [[nodiscard]] std::string interruption(const session::Snapshot& snapshot) const;
  void begin_identify();
  void end_identify(const session::Snapshot& snapshot);
  void take_identified();

  // application_recordings.cpp
  void open_wanted_recording();
  void take_opened_recording();
  void show_recording(std::unique_ptr<session::ReplaySession> replay);
  void end_live_session();
  void go_back();
  void notice_jumps();

  Sessions sessions_;
  std::shared_ptr<BorrowedAlgorithm> borrowed_;     // in the loop of live_; outlives it
  std::unique_ptr<session::LiveSession> live_;      // null while a recording is shown
  std::unique_ptr<session::ReplaySession> replay_;  // null while a session is live
  std::unique_ptr<WallRenderer> renderer_;
  std::unique_ptr<WallRenderer> other_renderer_;  // of the other wall of the first window
  draw::Theme theme_;
  draw::Look look_ = draw::Look::kScreen;  // look in force, as the scale
  float scale_ = 0.0F;
  SettingsFile settings_;
  file::PluginWatch plugins_;
  std::function<double()> now_s_;
  // The scene before a replay, and the one to which its values can be reset.
  struct Before {
    Scene scene;
    Scene loaded;
  };
  std::optional<Before> before_;
  // The session before an identification, and the identification's own scene.
  struct BeforeIdentify {
    Scene scene;
    bool repeats = false;
    bool paused = false;
    std::uint32_t generation = 0;
  } before_identify_;
  Scene in_force_;                         // the newest one that the loop has echoed,
  std::uint32_t in_force_generation_ = 0;  // and its number; 0: none of this session
  std::uint32_t jumps_ = 0;                // jumps of the replay that were handled
  UiState state_;
  draw::TickHistory history_;
  std::vector<Tick> incoming_;
  PaintGate paint_gate_;
  bool samples_came_ = false;  // samples came in the last frame
  sound::SoundPlayer sound_;
};

}  // namespace hapticwall::ui
