#include "tests/window/window_test.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_te_context.h>
#include <imgui_te_engine.h>

#include <algorithm>
#include <cfloat>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/disk/user_folders.h"
#include "app/file/scene/scene_file.h"
#include "tests/app/ui/display.h"
#include "tests/app/ui/items.h"

namespace hapticwall::test {
namespace {

// A small window with small pictures, because painting is slow without a graphics card.
constexpr int kWidth = 1120;
constexpr int kHeight = 720;
constexpr int kPaintedOf = 50;
constexpr const char* kDocked =
    "X21.5em(Controls;Y22%(X40%(Wall;Contact);Plots*,Timing,Blind test,Map,All at "
    "once,Study,Identify))";

// The test engine for one script, in the current ImGui context.
class Engine {
 public:
  Engine(ui::Application& application, const Script& script, ItemLog& log, Person::Drop drop)
      : application_(&application), log_(&log), engine_(ImGuiTestEngine_CreateContext()) {
    ImGuiTestEngineIO& io = ImGuiTestEngine_GetIO(engine_);
    io.ConfigSavedSettings = false;
    io.ConfigMouseDrawCursor = false;
    io.ConfigWatchdogWarning = FLT_MAX;
    io.ConfigWatchdogKillTest = FLT_MAX;
    ImGuiTest* test = ImGuiTestEngine_RegisterTest(engine_, "window", "script");
    test->TestFunc = [=, this, drop = std::move(drop)](ImGuiTestContext* context) {
      Person person(*context, *application_, *log_, drop);
      script(person);
    };
    test_ = test;
    ImGuiTestEngine_Start(engine_, ImGui::GetCurrentContext());
    watch_items_beside_engine();
    ImGuiTestEngine_QueueTest(engine_, test);
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine() {
    EXPECT_EQ(test_->Output.Status, ImGuiTestStatus_Success) << test_->Output.Log.GetText();
    ImGuiTestEngine_Stop(engine_);
    ImGuiTestEngine_DestroyContext(engine_);
  }

  [[nodiscard]] bool is_done() const { return ImGuiTestEngine_IsTestQueueEmpty(engine_); }

  // Call it after every frame.
  void look() {
    for (const auto& [name, rect] : drawn_items())
      if (rect.id != 0) log_->seen.insert(kind_of(name));
  }

 private:
  ui::Application* application_;
  ItemLog* log_;
  ImGuiTestEngine* engine_;
  ImGuiTest* test_ = nullptr;
};

// Calls the callback that GLFW calls for a drop.
void drop_onto(GLFWwindow* window, std::span<const std::string> paths) {
  const GLFWdropfun callback = glfwSetDropCallback(window, nullptr);
  glfwSetDropCallback(window, callback);
  ASSERT_NE(callback, nullptr);
  std::vector<const char*> names;
  for (const std::string& path : paths) names.push_back(path.c_str());
  callback(window, static_cast<int>(names.size()), names.data());
}

}  // namespace

Home::Home() {
  const nlohmann::json settings{
      {"window",
       {{"width", kWidth},
        {"height", kHeight},
        {"more", true},
        {"tour_offered", false},
        {"docked", kDocked}}},
      {"compare", {{"open", true}}},
      {"plots",
       {{"arrangement", "all"}, {"encoder_counts", true}, {"time_window_follows", false}}}};
  EXPECT_FALSE(file::make_folder_of(settings_path()));
  EXPECT_FALSE(file::write_file(settings_path(), settings.dump()));
}

std::string Home::settings_path() const {
  return file::settings_path([this](const std::string& name) -> std::optional<std::string> {
    if (name == "XDG_CONFIG_HOME") return folder_.file("config");
    return std::nullopt;
  });
}

std::string Home::write(Scene scene, const std::string& name) const {
  scene.name = name;
  std::string path = folder_.file(name + ".toml");
  EXPECT_FALSE(file::write_file(path, file::scene_to_toml(scene)));
  return path;
}

std::string Home::write_scene(const std::string& name, const std::string& builtin,
                              const std::vector<std::string>& changes) const {
  const Result<file::LoadedScene> loaded = file::load_scene(builtin, changes);
  EXPECT_TRUE(loaded.ok()) << loaded.error().message;
  return write(loaded->scene, name);
}

std::string Home::write_scene_of_two_walls(const std::string& name) const {
  constexpr double kBehindM = 0.005;
  Scene scene = file::load_scene("press")->scene;
  scene.x().walls.push_back(scene.x().walls.front());
  scene.x().walls.back().position_m += kBehindM;
  return write(scene, name);
}

std::vector<std::string> Home::files(const std::string& ending) const {
  std::vector<std::string> paths = folder_.names(ending);
  for (std::string& path : paths) path = folder_.file(path);
  return paths;
}

void WindowTest::SetUp() {
  if (!has_display()) GTEST_SKIP() << "DISPLAY is not set";
  options_.scene = file::load_scene("press")->scene;
  options_.settings_path = home_.settings_path();
  options_.recording_folder = home_.folder().string();
}

void WindowTest::use(const Script& script) {
  std::unique_ptr<Engine> engine;
  GLFWwindow* window = nullptr;
  ui::WindowHooks hooks;
  hooks.painted_of = kPaintedOf;
  hooks.opened = [&](ui::Application& application) {
    window = glfwGetCurrentContext();
    application.state().window.status_shown = true;
    application.state().sound.available = true;
    engine = std::make_unique<Engine>(
        application, script, log_,
        [window](std::span<const std::string> paths) { drop_onto(window, paths); });
  };
  hooks.drawn = [&] {
    engine->look();
    if (engine->is_done()) glfwSetWindowShouldClose(window, GLFW_TRUE);
  };
  hooks.closed = [&] { engine.reset(); };
  const Failure failure = ui::run_window(options_, hooks);
  EXPECT_FALSE(failure) << failure->message;
}

void WindowTest::connect_device() {
  options_.start_on_device =
      [this](const Scene& scene,
             BorrowedAlgorithm* /*borrowed*/) -> Result<std::unique_ptr<session::LiveSession>> {
    auto session = std::make_unique<FakeSession>(scene);
    session->info = {"paddle", false};
    session->arming.state = session::ArmingState::kOff;
    device_ = session.get();
    return std::unique_ptr<session::LiveSession>(std::move(session));
  };
}

}  // namespace hapticwall::test
