// The exit status of the program with a window, and its end if the loop hangs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <string>

#include "app/ui/window/window.h"
#include "tests/app/command/binary.h"
#include "tests/app/ui/display.h"

namespace hapticwall::ui {
namespace {

using command::test::Answer;
using ::testing::AnyOf;
using ::testing::HasSubstr;

class WindowEnd : public command::test::ProgramTest {
 protected:
  void SetUp() override {
    if (!test::has_display()) GTEST_SKIP() << "no display";
    setenv("XDG_CONFIG_HOME", path("settings").c_str(), 1);
  }
  void TearDown() override { unsetenv("XDG_CONFIG_HOME"); }
};

TEST_F(WindowEnd, ASignalIsItsExitStatus) {
  for (const auto& [signal, name] : {std::pair{SIGTERM, "SIGTERM"}, {SIGINT, "Ctrl-C"}}) {
    const Answer answer = terminated(
        {"press"}, [] { return true; }, signal);
    EXPECT_EQ(answer.status, 128 + signal) << answer.err;
    EXPECT_THAT(answer.err, HasSubstr(std::string("ended early by ") + name));
  }
}

TEST_F(WindowEnd, ASignalIsTheExitStatusOfAReplayToo) {
  ASSERT_EQ(hapticwall({"run", "tap", "--csv", "a.csv", "--quiet"}).status, 0);
  EXPECT_EQ(terminated({"a.csv"}).status, 128 + SIGTERM);
  EXPECT_EQ(terminated({"replay", "a.csv"}).status, 128 + SIGTERM);
}

TEST_F(WindowEnd, OneSignalEndsAWindowWhoseLoopHangs) {
  const std::string plugin =
      hapticwall::test::plugin_folder() + "/ending_algorithm_endless_step.so";
  EXPECT_THAT(terminated({"press", "--algorithm", plugin}).status,
              AnyOf(128 + SIGTERM, 128 + SIGXCPU));
}

// A desktop finds entry and icon of a window by its class.
TEST_F(WindowEnd, TheClassOfTheWindowIsTheIdOfTheDesktopEntry) {
  if (wait_for(start({"/bin/sh", "-c", "command -v xprop"})).status != 0)
    GTEST_SKIP() << "no xprop";
  std::string told;
  const auto is_shown = [&] {
    told = wait_for(start({"/usr/bin/env", "xprop", "-name", "Haptic Wall", "WM_CLASS"})).out;
    return told.starts_with("WM_CLASS");
  };
  EXPECT_EQ(terminated({"press"}, is_shown, SIGTERM).status, 128 + SIGTERM);
  const std::string id = std::string("\"") + kApplicationId + "\"";
  EXPECT_EQ(told, "WM_CLASS(STRING) = " + id + ", " + id + "\n");
}

}  // namespace
}  // namespace hapticwall::ui
