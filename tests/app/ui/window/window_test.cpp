// The real window, on the display that the tests are given (`./dev test` brings its own).
#include "app/ui/window/window.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

#include "app/file/scene/scene_file.h"
#include "tests/app/ui/display.h"

namespace hapticwall::ui {
namespace {

using Handler = void (*)(int);

Handler current_handler(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler;
}

// Opens the window on a real session, and sends the signal as soon as a handler is installed.
void expect_clean_end(int signal) {
  session::WindowOptions options;
  options.scene = file::load_scene("press")->scene;
  const Handler before = current_handler(signal);
  std::atomic<bool> ended{false};
  std::thread other([&] {
    while (current_handler(signal) == before && !ended.load()) std::this_thread::yield();
    if (!ended.load()) kill(getpid(), signal);
  });
  const Failure failure = run_window(options);
  ended.store(true);
  other.join();
  EXPECT_FALSE(failure) << failure->message;
  EXPECT_EQ(current_handler(signal), before);
}

TEST(Window, EndsInOrderWhenAskedTo) {
  if (!test::has_display()) GTEST_SKIP() << "no display";
  expect_clean_end(SIGTERM);
  expect_clean_end(SIGINT);
}

TEST(Window, SaysWhatToDoWithoutADisplay) {
  const char* display = std::getenv("DISPLAY");
  const std::string saved = display != nullptr ? display : "";
  unsetenv("DISPLAY");
  session::WindowOptions options;
  options.scene = file::load_scene("press")->scene;
  const Failure failure = run_window(options);
  if (!saved.empty()) setenv("DISPLAY", saved.c_str(), 1);
  ASSERT_TRUE(failure);
  EXPECT_NE(failure->message.find("hapticwall run"), std::string::npos) << failure->message;
}

}  // namespace
}  // namespace hapticwall::ui
