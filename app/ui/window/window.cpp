#include "app/ui/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_internal.h>

#include <algorithm>
#include <memory>
#include <string>

#include "app/draw/plot/theme.h"
#include "app/session/loop/stop_signals.h"
#include "app/session/loop_session.h"
#include "app/ui/page/identify_page.h"
#include "app/ui/state/window_state.h"
#include "app/ui/window/application.h"
#include "app/ui/window/display_end.h"
#include "app/ui/window/settings_file.h"
#include "app/ui/window/surface.h"

namespace hapticwall::ui {
namespace {

constexpr int kWidth = 1600;
constexpr int kHeight = 1000;
constexpr int kMinWidth = 1000;
constexpr int kMinHeight = 640;
constexpr double kUnseenFrameS = 0.1;  // sampling interval while minimised

std::string glfw_message() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason given";
}

// Initialises and terminates GLFW.
class Glfw {
 public:
  Glfw() : ready_(glfwInit() == GLFW_TRUE) {}
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
  ~Glfw() { glfwTerminate(); }
  [[nodiscard]] bool ready() const { return ready_; }

 private:
  bool ready_;
};

struct DestroyWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowHandle = std::unique_ptr<GLFWwindow, DestroyWindow>;

// Window size in the settings.
WindowState kept_window(const std::string& settings_path) {
  UiState state;
  SettingsFile(settings_path).load(state);
  return state.window;
}

// The stored size, limited to the screen.
ImVec2 wanted_size(const WindowState& kept) {
  int width = kept.width > 0 ? kept.width : kWidth;
  int height = kept.height > 0 ? kept.height : kHeight;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    int x = 0;
    int y = 0;
    int available_width = width;
    int available_height = height;
    glfwGetMonitorWorkarea(monitor, &x, &y, &available_width, &available_height);
    width = std::min(width, available_width);
    height = std::min(height, available_height);
  }
  return {static_cast<float>(width), static_cast<float>(height)};
}

WindowHandle open_window(const WindowState& kept) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_MAXIMIZED, kept.maximised ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, kApplicationId);
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, kApplicationId);
#ifdef GLFW_WAYLAND_APP_ID  // GLFW 3.4
  glfwWindowHintString(GLFW_WAYLAND_APP_ID, kApplicationId);
#endif
  const ImVec2 size = wanted_size(kept);
  WindowHandle window(glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y),
                                       "Haptic Wall", nullptr, nullptr));
  if (!window) return window;
  glfwSetWindowSizeLimits(window.get(), kMinWidth, kMinHeight, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  return window;
}

// Stores the size. A maximised window keeps its previous size.
void keep_window(GLFWwindow* window, WindowState& kept) {
  kept.maximised = glfwGetWindowAttrib(window, GLFW_MAXIMIZED) == GLFW_TRUE;
  if (kept.maximised || glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE) return;
  int width = 0;
  int height = 0;
  glfwGetWindowSize(window, &width, &height);
  // GLFW applies this scale again to a new window.
  const float scale = std::max(ImGui_ImplGlfw_GetContentScaleForWindow(window), 1.0F);
  kept.width = static_cast<int>(static_cast<float>(width) / scale);
  kept.height = static_cast<int>(static_cast<float>(height) / scale);
}

bool is_seen(GLFWwindow* window) {
  return glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_FALSE &&
         glfwGetWindowAttrib(window, GLFW_VISIBLE) == GLFW_TRUE;
}

// True when there is user input to handle.
bool user_acts() { return !ImGui::GetCurrentContext()->InputEventsQueue.empty(); }

void run_loop(GLFWwindow* window, Application& application, const WindowHooks& hooks) {
  Idleness idleness;
  int unpainted = 0;
  if (hooks.opened) hooks.opened(application);
  while (glfwWindowShouldClose(window) == GLFW_FALSE && session::stop_signal() == 0) {
    glfwPollEvents();
    if (!is_seen(window)) {
      application.take_ticks();
      leave_identify_page(application.state().identify);
      glfwWaitEventsTimeout(kUnseenFrameS);
      continue;
    }
    const double start_s = glfwGetTime();
    application.set_screen_scale(std::max(ImGui_ImplGlfw_GetContentScaleForWindow(window), 1.0F));
    const bool acts = user_acts();
    draw_frame(application);
    if (++unpainted >= hooks.painted_of) {
      if (application.needs_painting()) paint_frame(window);
      unpainted = 0;
    }
    if (hooks.drawn) hooks.drawn();
    if (acts || application.moving()) idleness.wake(glfwGetTime());
    // Limits the frame rate if swapping does not wait; events end the wait early.
    const double now_s = glfwGetTime();
    application.note_frame(now_s - start_s, now_s);
    const double rest_s = idleness.frame_s(now_s) - (now_s - start_s);
    if (hooks.painted_of == 0 && rest_s > 0.0) glfwWaitEventsTimeout(rest_s);
  }
  if (hooks.closed) hooks.closed();
  keep_window(window, application.state().window);
  application.save_settings();
}

}  // namespace

Failure run_window(const session::WindowOptions& options, const WindowHooks& hooks) {
  const session::StopSignals signals;
  const Glfw glfw;
  if (!glfw.ready()) {
    return Error{ErrorKind::kDevice,
                 "no window: " + glfw_message() +
                     " (`hapticwall run` and `replay --json -` need no display)"};
  }
  const WindowHandle window = open_window(kept_window(options.settings_path));
  if (!window) return Error{ErrorKind::kDevice, "no window with OpenGL 3.3: " + glfw_message()};
  const Gui gui(window.get());
  const draw::Theme theme =
      apply_theme(draw::Look::kScreen, 1.0F);  // the application applies the settings
  Application::Sessions sessions;
  sessions.simulate = [&options](const Scene& scene, BorrowedAlgorithm* borrowed) {
    session::SessionOptions session;
    session.spin_s = options.spin_s;
    session.stream = options.stream;
    session.signals = options.signals;
    return session::start_under(borrowed, nullptr, scene, session);
  };
  sessions.start_on_device = options.start_on_device;
  sessions.replay = options.replay;
  const auto application = Application::create(
      options.scene,
      {options.settings_path, options.recording_folder, options.forced_scale, options.opened_file,
       glfwGetTime, options.experiment, !options.signals.empty()},
      theme, sessions);
  if (!application) return application.error();
  (*application)->state().identify.device = options.device;
  (*application)->state().identify.description = options.description;
  const InputTarget input(window.get(), **application);
  const DisplayEnd display_end(**application);
  run_loop(window.get(), **application, hooks);
  return lost_compositor();
}

}  // namespace hapticwall::ui
