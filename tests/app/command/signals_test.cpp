// Stop signals, with a device that pushes.
#include "app/command/signals.h"

#include <gtest/gtest.h>

#include <csignal>

#include "tests/app/runtime/loop/child_support.h"

namespace hapticwall::command {
namespace {

using runtime::test::eventually;
using runtime::test::expect_killed_by;
using runtime::test::pushing_session;
using runtime::test::Shared;
using runtime::test::start_child;
using runtime::test::status_of;

class StopSignal : public ::testing::TestWithParam<int> {};

TEST_P(StopSignal, EndsTheSessionWithZeroForce) {
  const int signal = GetParam();
  const Shared heard;
  const pid_t child = start_child([&] {
    catch_stop_signals();
    {
      const auto session = pushing_session(*heard);
      heard->go_on = true;
      if (!eventually([] { return stop_signal() != 0; })) return;
    }
    _exit(128 + stop_signal());
  });
  ASSERT_TRUE(eventually([&] { return heard->go_on.load(); }));
  ASSERT_EQ(kill(child, signal), 0);
  const int status = status_of(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + signal);
  EXPECT_TRUE(heard->pushed());
  EXPECT_EQ(heard->newest_n, 0.0);
  EXPECT_TRUE(heard->closed);
}

// The program hangs: the second signal ends it, after the force.
TEST_P(StopSignal, ASecondOneEndsWhatHangsWithZeroForce) {
  const int signal = GetParam();
  const Shared heard;
  const pid_t child = start_child([&] {
    catch_stop_signals();
    const auto session = pushing_session(*heard);
    heard->go_on = true;
    if (!eventually([] { return stop_signal() != 0; })) return;
    heard->note = 1;
    while (true) pause();
  });
  ASSERT_TRUE(eventually([&] { return heard->go_on.load(); }));
  ASSERT_EQ(kill(child, signal), 0);
  ASSERT_TRUE(eventually([&] { return heard->note == 1; }));
  EXPECT_TRUE(heard->pushed());
  ASSERT_EQ(kill(child, signal), 0);
  expect_killed_by(signal, status_of(child));
  EXPECT_EQ(heard->newest_n, 0.0);
  EXPECT_FALSE(heard->enabled);
  EXPECT_TRUE(heard->closed);
}

INSTANTIATE_TEST_SUITE_P(Both, StopSignal, ::testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace hapticwall::command
