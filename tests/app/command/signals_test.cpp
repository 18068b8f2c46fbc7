// Stop signals, with a device that pushes.
#include "app/command/signals.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "core/algorithm/plugin/library_call.h"
#include "tests/app/session/loop/child_support.h"

namespace hapticwall::command {
namespace {

using session::test::eventually;
using session::test::expect_killed_by;
using session::test::pushing_session;
using session::test::Shared;
using session::test::SharedDevice;
using session::test::start_child;
using session::test::status_of;

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

// The loop hangs: nobody else waits for a second signal.
TEST_P(StopSignal, TheFirstOneEndsALoopThatHangs) {
  const Shared heard;
  const pid_t child = start_child([&] {
    catch_stop_signals();
    auto device = std::make_unique<SharedDevice>(*heard);
    device->on_read = [&] {
      while (heard->pushed()) {
        heard->note = 1;
        pause();  // a loop that spins would meet RLIMIT_RTTIME, too
      }
    };
    const auto session = pushing_session(*heard, std::move(device));
    while (true) pause();
  });
  ASSERT_TRUE(eventually([&] { return heard->note == 1; }));
  ASSERT_EQ(kill(child, GetParam()), 0);
  expect_killed_by(GetParam(), status_of(child));
}

// The loop is sound when the signal comes, and hangs while the program ends.
TEST_P(StopSignal, TheFirstOneEndsALoopThatHangsAfterIt) {
  const Shared heard;
  const pid_t child = start_child([&] {
    catch_stop_signals();
    auto device = std::make_unique<SharedDevice>(*heard);
    device->on_read = [&] {
      while (heard->note == 1 && stop_signal() != 0) pause();
    };
    const auto session = pushing_session(*heard, std::move(device));
    heard->go_on = true;
    if (!eventually([] { return stop_signal() != 0; })) return;
    heard->note = 1;
  });
  ASSERT_TRUE(eventually([&] { return heard->go_on.load(); }));
  ASSERT_EQ(kill(child, GetParam()), 0);
  expect_killed_by(GetParam(), status_of(child));
}

// The process has no loop, as in a headless run.
TEST_P(StopSignal, TheFirstOneEndsACallThatHangs) {
  const Shared heard;
  const pid_t child = start_child([&] {
    catch_stop_signals();
    Pulse pulse;
    pulse.begin();
    const LibraryCall call{.library = "mine", .function = "step()", .pulse = &pulse};
    static_cast<void>(call_library(call, [&] {
      while (true) heard->note = 1;
    }));
  });
  ASSERT_TRUE(eventually([&] { return heard->note == 1; }));
  ASSERT_EQ(kill(child, GetParam()), 0);
  expect_killed_by(GetParam(), status_of(child));
}

// A program may take its time if nothing hangs.
TEST_P(StopSignal, DoesNotEndWhatIsAliveAndSlow) {
  const Shared heard;
  const pid_t child = start_child([&] {
    catch_stop_signals();
    const auto session = pushing_session(*heard);
    heard->go_on = true;
    if (!eventually([] { return stop_signal() != 0; })) return;
    const auto enough = heard->writes + 2500;  // two and a half seconds
    if (!eventually([&] { return heard->writes > enough; })) return;
    _exit(7);
  });
  ASSERT_TRUE(eventually([&] { return heard->go_on.load(); }));
  ASSERT_EQ(kill(child, GetParam()), 0);
  const int status = status_of(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

// ---- an end that main does not know of

TEST(EarlyExit, IsAnErrorWithTheStatusOfItsLibrary) {
  struct Case {
    LibraryCall call;
    int status;
  };
  for (const Case& one :
       {Case{{.library = "mine", .function = "step()"}, 2},
        Case{{.library = "mine", .function = "read()", .kind = ErrorKind::kDevice}, 3}}) {
    const pid_t child = start_child([&] {
      static_cast<void>(run_guarded([&]() -> Result<int> {
        static_cast<void>(call_library(one.call, [] { std::exit(0); }));
        return 0;
      }));
    });
    const int status = status_of(child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), one.status);
  }
}

TEST(EarlyExit, OfAnotherThreadOrByQuickExitIsAnErrorToo) {
  using End = void (*)();
  const std::vector<End> ends{[] { std::exit(0); }, [] { std::quick_exit(0); },
                              [] { std::thread([] { std::exit(0); }).join(); }};
  for (const End end : ends) {
    const pid_t child = start_child([&] {
      static_cast<void>(run_guarded([&]() -> Result<int> {
        end();
        return 0;
      }));
    });
    const int status = status_of(child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
  }
}

TEST(EarlyExit, AfterMainHasReturnedIsNone) {
  const pid_t child = start_child([&] {
    static_cast<void>(run_guarded([]() -> Result<int> { return 0; }));
    std::exit(9);
  });
  const int status = status_of(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 9);
}

INSTANTIATE_TEST_SUITE_P(Both, StopSignal, ::testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace hapticwall::command
