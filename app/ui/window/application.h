// The window's content: owns the session and everything the panels remember, and draws one frame of
// it. Knows nothing of GLFW.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/file/recording_reader.h"
#include "app/runtime/session.h"
#include "app/ui/sample_history.h"
#include "app/ui/settings_file.h"
#include "app/ui/theme.h"
#include "app/ui/ui_state.h"
#include "app/ui/wall_renderer.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::ui {

class Application {
 public:
  using SessionStarter = std::function<Result<std::unique_ptr<runtime::Session>>(const Scene&)>;
  // Called on a thread of its own, for a large recording takes a while to read.
  using RecordingOpener = std::function<Result<std::unique_ptr<runtime::Session>>(
      const std::string& csv_path, const file::ReadProgress& progress)>;
  struct Sessions {
    SessionStarter simulate;
    SessionStarter start_on_device;  // empty: everything is simulated
    RecordingOpener open_recording;  // empty: runtime::start_replay()
    // What is shown at first; empty: a session of the scene. Of a replay the scene is the one to go
    // back to.
    std::function<Result<std::unique_ptr<runtime::Session>>()> first;
  };

  // What the window keeps and was told, besides the scene.
  struct Options {
    std::string settings_path;          // empty: settings are neither read nor kept
    std::string recording_folder;       // empty: the one of the settings
    std::optional<float> forced_scale;  // empty: the settings, or the screen
    std::string opened_file;            // that the scene came from; empty: it is built in
  };

  // Needs current contexts of OpenGL 3.3, ImGui and ImPlot, for its whole life. Starts a session,
  // on the device where there is one to be driven.
  [[nodiscard]] static Result<std::unique_ptr<Application>> create(const Scene& scene,
                                                                   const Options& options,
                                                                   const Theme& theme,
                                                                   Sessions sessions);

  // Draws one frame, between ImGui::NewFrame() and ImGui::Render(); never waits for the loop.
  void frame();

  // Takes what the session has measured without drawing anything (a window that nobody sees).
  void take_samples();

  // What the screen asks for: 1 where everything has the size that it was designed with.
  void set_screen_scale(float scale) { state_.transient.screen_scale = scale; }

  // Files that were let go over the window: scenes, or recordings.
  void drop(std::span<const std::string> paths);

  // Something moves: the session, or a message that fades.
  [[nodiscard]] bool moving() const;
  // Writes the settings, where they have changed.
  void save_settings() { settings_.save(state_); }

  [[nodiscard]] runtime::Session& session() { return *session_; }
  [[nodiscard]] UiState& state() { return state_; }
  [[nodiscard]] const SampleHistory& history() const { return history_; }
  [[nodiscard]] const WallRenderer& renderer() const { return *renderer_; }

 private:
  Application(Sessions sessions, std::unique_ptr<runtime::Session> session,
              std::unique_ptr<WallRenderer> renderer, const Theme& theme, const Options& options);

  void keep_appearance();
  void start_wanted_scene();
  [[nodiscard]] bool start_anew(const Scene& scene);
  [[nodiscard]] bool start_beside_replay(const Scene& scene);
  void forget_session();

  // application_recordings.cpp
  void open_wanted_recording();
  void take_opened_recording();
  void show_recording(std::unique_ptr<runtime::Session> replay);
  void end_live_session();
  void go_back();
  void notice_jumps();
  [[nodiscard]] bool measured() const;

  Sessions sessions_;
  std::unique_ptr<runtime::Session> session_;
  std::unique_ptr<WallRenderer> renderer_;
  Theme theme_;
  Look look_ = Look::kScreen;  // in force, like the scale
  float scale_ = 0.0F;
  SettingsFile settings_;
  // The scene that ran before a replay, and the one that its values can be reset to.
  struct Before {
    Scene scene;
    Scene loaded;
  };
  std::optional<Before> before_;
  std::uint32_t jumps_ = 0;  // of the replay, that were noticed
  UiState state_;
  SampleHistory history_;
  SampleHistory y_history_;  // of the second axis, where the scene has one
  std::vector<Sample> incoming_;
  std::vector<Sample> incoming_y_;
  bool samples_came_ = false;  // in the last frame
};

}  // namespace hapticwall::ui
