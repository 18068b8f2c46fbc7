// The exit status of the program with a window, and its end if the loop hangs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <string>

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

}  // namespace
}  // namespace hapticwall::ui
