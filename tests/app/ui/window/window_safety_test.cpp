// The real window on a pushing device: the loop always continues, and the last output to the device
// is zero force.
#include <epoxy/gl.h>
// epoxy/gl.h must come first.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>

#include "app/file/recording/recording_reader.h"
#include "app/file/scene/scene_file.h"
#include "app/ui/window/application.h"
#include "app/ui/window/window.h"
#include "tests/app/ui/display.h"
#include "tests/app/ui/window/pushing_window.h"

namespace hapticwall::ui {
namespace {

using session::test::eventually;
using session::test::kAlive;
using session::test::Shared;
using test::PushingWindow;

void close_window() { glfwSetWindowShouldClose(glfwGetCurrentContext(), GLFW_TRUE); }

// ---- ends

TEST(WindowSafety, ClosedItTakesTheForceAway) {
  if (!test::has_display()) GTEST_SKIP() << "no display";
  Shared heard;
  PushingWindow window(heard);
  window.hooks.drawn = close_window;
  EXPECT_FALSE(run_window(window.options, window.hooks));
  window.expect_safe_end();
}

TEST(WindowSafety, AskedToEndItTakesTheForceAway) {
  if (!test::has_display()) GTEST_SKIP() << "no display";
  for (const int signal : {SIGINT, SIGTERM}) {
    Shared heard;
    PushingWindow window(heard);
    window.hooks.drawn = [signal] { raise(signal); };
    EXPECT_FALSE(run_window(window.options, window.hooks));
    window.expect_safe_end();
  }
}

TEST(WindowSafety, AnExceptionInAPanelTakesTheForceAway) {
  if (!test::has_display()) GTEST_SKIP() << "no display";
  Shared heard;
  PushingWindow window(heard);
  window.in_a_panel = [] { throw std::runtime_error("a panel"); };
  EXPECT_THROW(static_cast<void>(run_window(window.options, window.hooks)), std::runtime_error);
  window.expect_safe_end();
}

// Opens the window in this process, and dies of `fault` in one of its panels.
[[noreturn]] void die_in_a_panel(Shared& heard, void (*fault)()) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  PushingWindow window(heard);
  window.in_a_panel = fault;
  static_cast<void>(run_window(window.options, window.hooks));
  _exit(kAlive);
}

// A new process repeats this test up to its death. Both share a file with the state of the device.
class WindowDeath : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_display()) GTEST_SKIP() << "no display";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }
};

void use_wrong_pointer() {
  *static_cast<volatile int*>(mmap(nullptr, 4096, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) =
      1;
}

bool killed_or_ended_by_sanitizer(int status, int signal) {
#if defined(__SANITIZE_ADDRESS__)
  if (WIFEXITED(status)) return WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != kAlive;
#endif
  return WIFSIGNALED(status) && WTERMSIG(status) == signal;
}

TEST_F(WindowDeath, AFaultInAPanelTakesTheForceAwayFirst) {
  Shared heard("HAPTICWALL_TEST_HEARD");
  EXPECT_EXIT(
      die_in_a_panel(heard, use_wrong_pointer),
      [](int status) { return killed_or_ended_by_sanitizer(status, SIGSEGV); }, "");
  PushingWindow(heard).expect_safe_end();
}

TEST_F(WindowDeath, AnAbortInAPanelTakesTheForceAwayFirst) {
  Shared heard("HAPTICWALL_TEST_HEARD");
  EXPECT_EXIT(
      die_in_a_panel(heard, [] { std::abort(); }),
      [](int status) { return killed_or_ended_by_sanitizer(status, SIGABRT); }, "");
  PushingWindow(heard).expect_safe_end();
}

// The first signal asks for an end, which a hanging frame never reaches.
TEST_F(WindowDeath, AskedTwiceItEndsInTheMiddleOfAFrameForceFirst) {
  Shared heard("HAPTICWALL_TEST_HEARD");
  const auto ask_twice = [] {
    raise(SIGINT);
    raise(SIGINT);
    while (true) pause();
  };
  EXPECT_EXIT(
      die_in_a_panel(heard, ask_twice),
      [](int status) { return WIFSIGNALED(status) && WTERMSIG(status) == SIGINT; }, "");
  PushingWindow(heard).expect_safe_end();
}

// ---- slow frames

TEST(WindowSafety, AFrameThatHangsCostsNoTick) {
  if (!test::has_display()) GTEST_SKIP() << "no display";
  constexpr std::uint64_t kMeanwhile = 500;
  Shared heard;
  PushingWindow window(heard);
  Application* application = nullptr;
  std::uint64_t ticks = 0;
  int frames = 0;
  window.hooks.opened = [&](Application& opened) { application = &opened; };
  window.in_a_panel = [&] {
    if (++frames != 2) return;
    const std::uint64_t before = heard->writes;
    EXPECT_TRUE(eventually([&] { return heard->writes > before + kMeanwhile; }));
  };
  window.hooks.drawn = [&] {
    if (frames < 4) return;
    ticks = application->session().snapshot().timing.ticks;
    EXPECT_EQ(application->live()->dropped_plot_samples(), 0U) << "the queue holds a minute";
    close_window();
  };
  EXPECT_FALSE(run_window(window.options, window.hooks));
  EXPECT_GT(ticks, kMeanwhile);
  window.expect_safe_end();
}

TEST(WindowSafety, ATickThatHangsCostsNoFrame) {
  if (!test::has_display()) GTEST_SKIP() << "no display";
  constexpr int kMeanwhile = 10;
  Shared heard;
  PushingWindow window(heard);
  std::atomic<int> frames{-1};  // since the first one; -1 before it
  std::atomic<bool> went_on{false};
  window.in_a_tick = [&] {
    if (frames < 0 || went_on) return;
    EXPECT_TRUE(eventually([&] { return frames > kMeanwhile; }));
    went_on = true;
  };
  window.hooks.drawn = [&] {
    ++frames;
    if (went_on) close_window();
  };
  EXPECT_FALSE(run_window(window.options, window.hooks));
  window.expect_safe_end();
}

// The rows of a whole recording follow each other.
void expect_no_row_missing(const std::string& path) {
  const auto reader = file::RecordingReader::open(path);
  ASSERT_TRUE(reader.ok()) << reader.error().message;
  const file::ScannedRows& scanned = (*reader)->info().scanned;
  EXPECT_EQ(scanned.missing_rows, 0U);
  EXPECT_EQ(scanned.last_tick - scanned.first_tick + 1, scanned.rows);
  EXPECT_GT(scanned.rows, 0U);
  EXPECT_TRUE((*reader)->info().notes.empty());
}

// Two hundred sizes, a long text to the clipboard and back in each, while it records.
TEST(WindowSafety, AStormOfSizesCostsNoRowAndNoPicture) {
  if (!test::has_display()) GTEST_SKIP() << "no display";
  constexpr int kSizes = 200;
  const session::test::TemporaryFolder folder;
  const std::string path = folder.file("storm.csv");
  const std::string long_text(1U << 18U, 'x');
  std::mt19937 engine(1);
  int frames = 0;
  int sizes_seen = 0;
  ImVec2 size_before;
  Application* application = nullptr;
  session::WindowOptions options;
  options.scene = file::load_scene("press")->scene;
  WindowHooks hooks;
  hooks.painted_of = 10;
  hooks.opened = [&](Application& opened) {
    application = &opened;
    EXPECT_FALSE(opened.live()->start_recording(path));
  };
  hooks.drawn = [&] {
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << "frame " << frames;
    GLFWwindow* window = glfwGetCurrentContext();
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window, &width, &height);
    const ImVec2 drawn = ImGui::GetIO().DisplaySize;
    sizes_seen += drawn.x != size_before.x || drawn.y != size_before.y ? 1 : 0;
    size_before = drawn;
    ImGui::SetClipboardText(long_text.c_str());
    EXPECT_EQ(std::string(ImGui::GetClipboardText()), long_text);
    if (++frames == kSizes) {
      const session::RecordingStatus status = application->live()->recording_status();
      EXPECT_EQ(status.state, session::RecordingState::kRecording) << status.error;
      EXPECT_EQ(application->live()->dropped_plot_samples(), 0U);
      EXPECT_FALSE(application->session().snapshot().ended_by_fault);
      return close_window();
    }
    const auto any = [&](int low, int high) {
      return low + static_cast<int>(engine() % static_cast<unsigned>(high - low));
    };
    glfwSetWindowSize(window, any(200, 2200), any(100, 1400));
  };
  EXPECT_FALSE(run_window(options, hooks));
  EXPECT_EQ(frames, kSizes);
  EXPECT_GT(sizes_seen, kSizes / 2);
  expect_no_row_missing(path);
}

}  // namespace
}  // namespace hapticwall::ui
