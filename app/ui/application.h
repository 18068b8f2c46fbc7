// The window's content: owns the session and everything the panels remember, and draws one frame of
// it. Knows nothing of GLFW.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/runtime/session.h"
#include "app/ui/sample_history.h"
#include "app/ui/theme.h"
#include "app/ui/ui_state.h"
#include "app/ui/wall_renderer.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::ui {

class Application {
 public:
  using SessionStarter = std::function<Result<std::unique_ptr<runtime::Session>>(const Scene&)>;
  struct Sessions {
    SessionStarter simulate;
    SessionStarter start_on_device;  // empty: everything is simulated
  };

  // Needs current contexts of OpenGL 3.3, ImGui and ImPlot, for its whole life. Starts a session,
  // on the device where there is one to be driven.
  [[nodiscard]] static Result<std::unique_ptr<Application>> create(
      const Scene& scene, const std::string& recording_folder, const Theme& theme,
      Sessions sessions);

  // Draws one frame, between ImGui::NewFrame() and ImGui::Render(); never waits for the loop.
  void frame();

  // Takes what the session has measured without drawing anything (a window that nobody sees).
  void take_samples();

  [[nodiscard]] runtime::Session& session() { return *session_; }
  [[nodiscard]] UiState& state() { return state_; }
  [[nodiscard]] const SampleHistory& history() const { return history_; }
  [[nodiscard]] const WallRenderer& renderer() const { return *renderer_; }

 private:
  Application(Sessions sessions, std::unique_ptr<runtime::Session> session,
              std::unique_ptr<WallRenderer> renderer, const Theme& theme,
              const std::string& recording_folder);

  void handle_keys(const PanelContext& context);
  void draw_layout(const PanelContext& context);
  void draw_left(const PanelContext& context, float height);
  void draw_right(const PanelContext& context, float height);
  void draw_views(const PanelContext& context);
  void start_wanted_scene();
  [[nodiscard]] bool start_anew(const Scene& scene);

  Sessions sessions_;
  std::unique_ptr<runtime::Session> session_;
  std::unique_ptr<WallRenderer> renderer_;
  Theme theme_;
  UiState state_;
  SampleHistory history_;
  std::vector<Sample> incoming_;
};

}  // namespace hapticwall::ui
