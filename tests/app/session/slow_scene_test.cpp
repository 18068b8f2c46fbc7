// The slowest scenes that are accepted: a tick takes many periods, and a live session goes on.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "app/session/live_session.h"
#include "tests/app/session/loop/servo_loop_support.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;
using test::expect_without_gap;
using test::Harness;
using test::lines_of;
using test::rows_reach;
using test::started;
using test::TemporaryFolder;
using test::ticks_reach;

constexpr double kMaxRateHz = 100e3;

// The most substeps, at the highest rate.
Scene slow_scene() {
  Scene scene = contact_scene(kMaxRateHz);
  scene.simulator = {Integrator::kRungeKutta4, kMaxSubsteps};
  return scene;
}

Scene slow_scene_of_two_axes() {
  Scene scene = slow_scene();
  scene.axes.push_back(scene.x());
  return scene;
}

// Every cycle takes at least 40 periods of 10 µs: 20 up to its start, 20 up to its end.
class SlowMachine : public test::FakeClock {
 public:
  static constexpr std::int64_t kMissedPerCycle = 39;
  [[nodiscard]] std::int64_t now_ns() override {
    constexpr std::int64_t kStepNs = 200'000;
    advance_ns(kStepNs);
    // The loop is always late, so it does not sleep, and may have real-time priority: without this
    // pause the recorder's thread gets no core when another such test runs beside it.
    std::this_thread::sleep_for(std::chrono::nanoseconds(kStepNs));
    return FakeClock::now_ns();
  }
};

TEST(SlowScene, MissesAreCountedAndEveryTickIsShownAndRecorded) {
  constexpr std::uint64_t kRows = 200;
  const TemporaryFolder folder;
  for (const Scene& scene : {slow_scene(), slow_scene_of_two_axes()}) {
    const std::string csv = folder.file(std::to_string(scene.axes.size()) + ".csv");
    SlowMachine machine;
    SessionOptions options;
    options.clock = &machine;
    const auto session = started(scene, options);
    ASSERT_FALSE(session->start_recording(csv));
    ASSERT_TRUE(rows_reach(*session, kRows));
    const Snapshot before = session->snapshot();
    ASSERT_TRUE(ticks_reach(*session, before.timing.ticks + 10)) << "snapshots keep coming";
    EXPECT_GE(before.timing.missed_ticks,
              (before.timing.ticks - 1) * std::uint64_t{SlowMachine::kMissedPerCycle});
    EXPECT_FALSE(before.ended_by_fault);
    EXPECT_EQ(before.newest.x().flags & kFlagDeviceFault, 0U);
    const Failure failure = session->stop_recording();
    ASSERT_FALSE(failure) << failure->message;
    const auto lines = lines_of(csv);
    ASSERT_GT(lines.size(), kRows);
    EXPECT_EQ(lines.size(), session->recording_status().rows + 1);
    expect_without_gap(lines, test::tick_of(lines[1]));
    if (scene.axes.size() == 1) test::expect_repeated(lines, folder.file("1.toml"));
  }
}

// The tick that runs is the only work between a request to stop and the end.
TEST(SlowScene, ItEndsAfterTheTickThatRuns) {
  constexpr std::uint64_t kTicks = 50;
  Harness bench(slow_scene());
  std::uint64_t sleeps = 0;
  bench.clock.after_sleep = [&](test::FakeClock& /*clock*/) {
    if (++sleeps == kTicks) bench.exchange.stop = true;
  };
  run_servo_loop(bench.loop, bench.exchange, kMaxRateHz, bench.clock);
  EXPECT_EQ(bench.snapshot().timing.ticks, kTicks);
  EXPECT_EQ(bench.snapshot().newest.x().force_n, 0.0);
}

// A disk that takes nothing for a while: rows that no longer fit are counted and reported.
TEST(SlowScene, RowsThatDoNotFitAreReported) {
  const TemporaryFolder folder;
  SlowMachine machine;
  SessionOptions options;
  options.clock = &machine;
  options.queues.recorder = 1;
  const auto session = started(slow_scene(), options);
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  ASSERT_TRUE(test::eventually(
      [&] { return session->recording_status().dropped_rows > 0 && rows_reach(*session, 2); }));
  const Failure failure = session->stop_recording();
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, ErrorKind::kFile);
  EXPECT_NE(failure->message.find("rows are missing"), std::string::npos) << failure->message;
}

}  // namespace
}  // namespace hapticwall::session
