#include "app/ui/window.h"

#include <epoxy/gl.h>
// After OpenGL's own header.
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <memory>
#include <string>

#include "app/ui/application.h"
#include "app/ui/theme.h"

namespace hapticwall::ui {
namespace {

constexpr int kWidth = 1600;
constexpr int kHeight = 1000;
constexpr int kSmallestWidth = 1000;
constexpr int kSmallestHeight = 640;
constexpr double kFrameS = 1.0 / 60.0;
constexpr double kUnseenFrameS = 0.1;  // how often samples are taken while minimised

// A signal handler may touch nothing but this.
std::atomic<bool> end_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void request_end(int /*signal*/) { end_requested.store(true, std::memory_order_relaxed); }

// SIGINT and SIGTERM ask for an end in good order while this lives.
class EndSignals {
 public:
  EndSignals() {
    end_requested.store(false, std::memory_order_relaxed);
    struct sigaction action {};
    action.sa_handler = request_end;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < kSignals.size(); ++i)
      sigaction(kSignals[i], &action, &previous_[i]);
  }
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;
  ~EndSignals() {
    for (std::size_t i = 0; i < kSignals.size(); ++i)
      sigaction(kSignals[i], &previous_[i], nullptr);
  }

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM};
  std::array<struct sigaction, kSignals.size()> previous_{};
};

std::string glfw_message() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason given";
}

// GLFW, from first to last.
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

WindowHandle open_window() {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  int width = kWidth;
  int height = kHeight;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    int x = 0;
    int y = 0;
    int available_width = kWidth;
    int available_height = kHeight;
    glfwGetMonitorWorkarea(monitor, &x, &y, &available_width, &available_height);
    width = std::min(width, available_width);
    height = std::min(height, available_height);
  }
  WindowHandle window(glfwCreateWindow(width, height, "Haptic Wall", nullptr, nullptr));
  if (!window) return window;
  glfwSetWindowSizeLimits(window.get(), kSmallestWidth, kSmallestHeight, GLFW_DONT_CARE,
                          GLFW_DONT_CARE);
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  return window;
}

// ImGui and ImPlot with their backends for the window.
class Gui {
 public:
  explicit Gui(GLFWwindow* window) {
    ImGui::CreateContext();
    ImPlot::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
  }
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;
  ~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImPlot::DestroyContext();
    ImGui::DestroyContext();
  }
};

void draw_frame(GLFWwindow* window, Application& application) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  application.frame();
  ImGui::Render();
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  glViewport(0, 0, width, height);
  const ImVec4 background = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  glClearColor(background.x, background.y, background.z, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window);
}

bool is_seen(GLFWwindow* window) {
  return glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_FALSE &&
         glfwGetWindowAttrib(window, GLFW_VISIBLE) == GLFW_TRUE;
}

void run_loop(GLFWwindow* window, Application& application) {
  while (glfwWindowShouldClose(window) == GLFW_FALSE &&
         !end_requested.load(std::memory_order_relaxed)) {
    glfwPollEvents();
    if (!is_seen(window)) {
      application.take_samples();
      glfwWaitEventsTimeout(kUnseenFrameS);
      continue;
    }
    const double start_s = glfwGetTime();
    draw_frame(window, application);
    // Where swapping does not wait for the screen, we do; events end the wait early.
    const double rest_s = kFrameS - (glfwGetTime() - start_s);
    if (rest_s > 0.0) glfwWaitEventsTimeout(rest_s);
  }
}

}  // namespace

Failure run_window(const WindowOptions& options) {
  const EndSignals signals;
  const Glfw glfw;
  if (!glfw.ready()) {
    return Error{ErrorKind::kDevice,
                 "no window: " + glfw_message() + " (`hapticwall run` needs no display)"};
  }
  const WindowHandle window = open_window();
  if (!window) return Error{ErrorKind::kDevice, "no window with OpenGL 3.3: " + glfw_message()};
  const Gui gui(window.get());
  float scale = 1.0F;
  glfwGetWindowContentScale(window.get(), &scale, nullptr);
  const Theme theme = apply_theme(Look::kScreen, std::max(scale, 1.0F));
  Application::Sessions sessions;
  sessions.simulate = [](const Scene& scene) { return runtime::Session::start(scene); };
  sessions.start_on_device = options.start_on_device;
  const auto application =
      Application::create(options.scene, options.recording_folder, theme, sessions);
  if (!application) return application.error();
  run_loop(window.get(), **application);
  return std::nullopt;
}

}  // namespace hapticwall::ui
