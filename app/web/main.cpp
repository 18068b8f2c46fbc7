// The window in a browser: the desktop's Application on a canvas, without threads, files and
// devices. index.html passes the parameters of the link as arguments.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <emscripten.h>
#include <imgui_impl_glfw.h>
#include <imgui_internal.h>

#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/draw/plot/theme.h"
#include "app/file/scene/scene_file.h"
#include "app/session/loop_session.h"
#include "app/ui/window/application.h"
#include "app/ui/window/surface.h"
#include "app/ui/window/window.h"

namespace hapticwall::web {
namespace {

// clang-format off
EM_JS(int, page_width, (), { return Math.max(1, window.innerWidth); })
EM_JS(int, page_height, (), { return Math.max(1, window.innerHeight); })
EM_JS_DEPS(clipboard, "$stringToNewUTF8");
EM_JS(char*, clipboard_of_page, (), { return stringToNewUTF8(Module.clipboard); })
EM_JS(void, copy_to_page, (const char* text), {
  Module.clipboard = UTF8ToString(text);
  if (navigator.clipboard) navigator.clipboard.writeText(Module.clipboard).catch(() => {});
})
EM_JS(void, note_frame_of_page, (double frame_ms), { Module.noteFrame(frame_ms); })
// clang-format on

constexpr ui::Capabilities kBrowser{false, false, false, false, false, false};

Result<std::unique_ptr<session::LiveSession>> start(const Scene& scene,
                                                    BorrowedAlgorithm* borrowed) {
  session::SessionOptions options;
  options.driver = session::Driver::kTurnedByOwner;
  return session::start_under(borrowed, nullptr, scene, options);
}

// GLFW's library for browsers has no clipboard.
void use_clipboard_of_page() {
  ImGuiPlatformIO& io = ImGui::GetPlatformIO();
  io.Platform_SetClipboardTextFn = [](ImGuiContext*, const char* text) { copy_to_page(text); };
  io.Platform_GetClipboardTextFn = [](ImGuiContext*) {
    static std::unique_ptr<char, decltype(&std::free)> kept(nullptr, &std::free);
    kept.reset(clipboard_of_page());
    return const_cast<const char*>(kept.get());
  };
}

// Lives as long as the page.
class Page {
 public:
  Page(GLFWwindow* window, std::unique_ptr<ui::Application> application)
      : window_(window), application_(std::move(application)), input_(window, *application_) {}

  [[nodiscard]] ui::Application& application() { return *application_; }

  void frame() {
    fit();
    glfwPollEvents();
    const double start_s = glfwGetTime();
    const bool acts = !ImGui::GetCurrentContext()->InputEventsQueue.empty();
    if (!acts && start_s < next_s_) {
      application_->take_ticks();
      if (!application_->moving()) return;
    }
    ui::draw_frame(*application_);
    if (application_->needs_painting()) ui::paint_frame(window_);
    const double now_s = glfwGetTime();
    application_->note_frame(now_s - start_s, now_s);
    note_frame_of_page((now_s - start_s) * 1e3);
    if (acts || application_->moving()) idleness_.wake(now_s);
    next_s_ = idleness_.idle(now_s) ? start_s + ui::kIdleFrameS : start_s;
  }

 private:
  // The canvas fills the page, whatever its size is now.
  void fit() {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window_, &width, &height);
    if (width == page_width() && height == page_height()) return;
    glfwSetWindowSize(window_, page_width(), page_height());
    application_->forget_painted();
    next_s_ = 0.0;
  }

  GLFWwindow* window_;
  std::unique_ptr<ui::Application> application_;
  ui::InputTarget input_;
  ui::Idleness idleness_;
  double next_s_ = 0.0;  // of the next frame, while nothing moves
};

Page* page = nullptr;

Failure open_page(const std::string& scene, std::span<const std::string> settings) {
  Result<file::LoadedScene> loaded = file::load_scene(scene, settings);
  if (!loaded) return loaded.error();
  if (glfwInit() != GLFW_TRUE) return Error{ErrorKind::kDevice, "this browser has no GLFW"};
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  GLFWwindow* window =
      glfwCreateWindow(page_width(), page_height(), "Haptic Wall", nullptr, nullptr);
  if (window == nullptr) return Error{ErrorKind::kDevice, "this browser has no WebGL 2"};
  glfwMakeContextCurrent(window);
  new ui::Gui(window);  // as long as the page
  ImGui_ImplGlfw_InstallEmscriptenCallbacks(window, "#canvas");
  use_clipboard_of_page();
  ui::Application::Options options;
  options.now_s = glfwGetTime;
  options.can = kBrowser;
  ui::Application::Sessions sessions;
  sessions.simulate = start;
  auto application = ui::Application::create(
      loaded->scene, options, draw::apply_theme(draw::Look::kScreen, 1.0F), sessions);
  if (!application) return application.error();
  page = new Page(window, std::move(*application));
  emscripten_set_main_loop([] { page->frame(); }, 0, false);
  return std::nullopt;
}

}  // namespace

// For tests of the page.
ui::Application& application_of_page() { return page->application(); }

}  // namespace hapticwall::web

// Tells Dear ImGui that a finger points. It then passes a press on a frame after the place of the
// press, because a control takes presses only while the pointer is known to be over it.
extern "C" EMSCRIPTEN_KEEPALIVE void point_by_finger(bool touches) {
  ImGui::GetIO().AddMouseSourceEvent(touches ? ImGuiMouseSource_TouchScreen
                                             : ImGuiMouseSource_Mouse);
}

// SCENE KEY=VALUE...
int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto failure =
      hapticwall::web::open_page(arguments.front(), std::span(arguments).subspan(1));
  if (!failure) return 0;
  std::fprintf(stderr, "%s\n", failure->message.c_str());
  return static_cast<int>(failure->kind);
}
