// One report at a time.
#include "app/runtime/loop/device_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/app/runtime/loop/loop_bench.h"

namespace hapticwall::runtime {
namespace {

constexpr double kTickS = 1e-3;
constexpr double kCountM = 1e-4;

class Judged : public ::testing::Test {
 protected:
  // The next report, a tick later by both clocks.
  ArmingNote at(double position_m, double device_step_s = kTickS, double host_step_s = kTickS) {
    reading.position_m = position_m;
    reading.device_time_s += device_step_s;
    return judge.judge(reading, link, host_step_s);
  }
  static device::DeviceInfo paddle() {
    device::DeviceInfo info;
    info.encoder_m = kCountM;
    info.motion = {-0.05, 0.06, 2.0};
    return info;
  }

  DeviceJudge judge{paddle()};
  DeviceReading reading{0.0, 0.0, DeviceState::kOk, 1.0};
  device::LinkStats link;
};

TEST_F(Judged, TheFirstPositionIsAnywhereInTheWorkspace) {
  EXPECT_EQ(at(0.06), ArmingNote::kNone);
  judge.forget();
  EXPECT_EQ(at(-0.05), ArmingNote::kNone);
  judge.forget();
  EXPECT_EQ(at(0.0601), ArmingNote::kImplausible);
  judge.forget();
  EXPECT_EQ(at(-0.0501), ArmingNote::kImplausible);
  judge.forget();
  EXPECT_EQ(at(std::numeric_limits<double>::quiet_NaN()), ArmingNote::kImplausible);
}

TEST_F(Judged, TheSpeedIsByTheClockOfTheDevice) {
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.0020), ArmingNote::kNone);
  EXPECT_EQ(at(0.00409), ArmingNote::kNone);  // one count more than 2 m/s
  EXPECT_EQ(at(0.0063), ArmingNote::kImplausible);
  EXPECT_EQ(at(0.0083), ArmingNote::kNone);  // the new place counts
  EXPECT_EQ(at(0.0123, 2e-3, kTickS), ArmingNote::kNone);
  EXPECT_EQ(at(0.0163, kTickS, 2e-3), ArmingNote::kImplausible);
}

TEST_F(Judged, WithoutAClockOfTheDeviceTheHostsCounts) {
  EXPECT_EQ(at(0.0, 0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.002, 0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.002, 0.0), ArmingNote::kNone);  // it reports at every third tick
  EXPECT_EQ(at(0.002, 0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.008, 0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.012, 0.0), ArmingNote::kImplausible);
}

TEST_F(Judged, AClockThatRunsAheadHidesNoJump) {
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.05, 1.0), ArmingNote::kImplausible);  // 20 ms count at most: 40 mm
  EXPECT_EQ(at(0.051, -1.0), ArmingNote::kImplausible);
}

TEST_F(Judged, WhatTheDeviceCallsAFaultIsNotJudged) {
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  reading.state = DeviceState::kFault;
  EXPECT_EQ(at(0.9), ArmingNote::kNone);
  reading.state = DeviceState::kOk;
  EXPECT_EQ(at(0.05), ArmingNote::kNone);  // unobserved motion
}

TEST_F(Judged, UnknownIsUnknown) {
  link.connected = true;
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  EXPECT_TRUE(judge.waits_for_answer());
  link.command_age_s = link.unanswered_s = 0.0201;
  EXPECT_EQ(at(0.0), ArmingNote::kNoAnswer);
  link.force_word = device::ForceWord::kSame;
  link.command_age_s = 0.02;
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  EXPECT_FALSE(judge.waits_for_answer());
  link.command_age_s = 0.0201;
  link.unanswered_s = 1e-3;
  EXPECT_EQ(at(0.0), ArmingNote::kSlowAnswer);
}

// A wheel of the kernel: the delay is unknown or from a file, and nothing is waited for.
TEST_F(Judged, WhatAcknowledgesNothingIsNotWaitedFor) {
  link.connected = true;
  link.acknowledges = false;
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  EXPECT_FALSE(judge.waits_for_answer());
  link.delay_s = 0.02;
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  link.delay_s = 0.0201;
  EXPECT_EQ(at(0.0), ArmingNote::kSlowAnswer);
}

TEST_F(Judged, AHandleThatGivesWayToTheFullForceShowsThatItDoesNotPush) {
  for (const int side : {1, -1}) {
    const auto pushed_to = [&](double along_m, int full_force) {
      reading.position_m = side * along_m;
      reading.device_time_s += 0.1;
      return judge.judge(reading, link, 0.1, side * full_force);
    };
    judge.forget();
    link.acknowledges = true;
    EXPECT_EQ(pushed_to(0.0, 1), ArmingNote::kNone);
    EXPECT_EQ(pushed_to(0.035, 1), ArmingNote::kNone) << "it would say so itself";
    link.acknowledges = false;
    EXPECT_EQ(pushed_to(0.0, 0), ArmingNote::kNone);
    EXPECT_EQ(pushed_to(0.03, 0), ArmingNote::kNone) << "no full force yet";
    EXPECT_EQ(pushed_to(0.01, 1), ArmingNote::kNone);
    EXPECT_EQ(pushed_to(0.04, 1), ArmingNote::kNone) << "the force pushed it to 10 mm";
    EXPECT_EQ(pushed_to(0.0, 1), ArmingNote::kNone);
    EXPECT_EQ(pushed_to(0.0301, 1), ArmingNote::kGivesWay);
    EXPECT_EQ(pushed_to(0.0301, 0), ArmingNote::kNone);
  }
}

// Its position follows the hand, whatever the program commands.
TEST(JudgedLoop, AWheelThatTakesNoOutputIsDisarmed) {
  Scene scene;
  scene.x().walls = {{0.05, 1000.0, 0.0}};
  scene.x().device.force_limit_n = 5.0;
  scene.algorithm.index = find_algorithm("none").value();
  test::LoopBench<test::FakeDevice> bench(scene);
  bench.device.position_m = 0.049;
  bench.device.figures.connected = true;
  bench.device.figures.acknowledges = false;
  bench.command(CommandKind::kArm);
  bench.cycles(600);
  ASSERT_EQ(bench.snapshot().arming.state, ArmingState::kOn);
  const auto push_to = [&](double to_m) {
    for (; bench.device.position_m < to_m; bench.device.position_m += 1e-4) bench.cycles(1);
  };
  push_to(0.0845);
  EXPECT_EQ(bench.snapshot().newest.x().force_n, 5.0) << "a strong hand may do that";
  push_to(0.0855);
  EXPECT_EQ(bench.snapshot().newest.x().force_n, 0.0);
  EXPECT_EQ(bench.snapshot().arming.note, ArmingNote::kGivesWay);
}

// Not even one command with force leaves in the tick of an objection, and the arming asks for an
// answer first.
TEST(JudgedLoop, AnObjectionGivesNoForceInTheSameTick) {
  Scene scene;
  scene.x().walls = {{0.05, 1000.0, 0.0}};
  scene.algorithm.index = find_algorithm("none").value();
  for (const bool jumps : {false, true}) {
    test::LoopBench<test::FakeDevice> bench(scene);
    bench.device.position_m = 0.049;
    bench.device.figures.connected = true;
    bench.command(CommandKind::kArm);
    bench.cycles(10);
    EXPECT_EQ(bench.snapshot().arming.state, ArmingState::kOff);
    EXPECT_EQ(bench.snapshot().arming.asked, 0U);
    bench.device.figures.force_word = device::ForceWord::kSame;
    bench.cycles(600);
    ASSERT_EQ(bench.snapshot().arming.state, ArmingState::kOn);
    bench.device.position_m = 0.052;
    bench.cycles(1);
    ASSERT_NEAR(bench.device.forces_n.back(), 2.0, 1e-9);
    const std::size_t written = bench.device.forces_n.size();
    if (jumps) bench.device.position_m = 1.2;
    if (!jumps) bench.device.figures.rejected_commands = 1;
    bench.cycles(1);
    for (std::size_t i = written; i < bench.device.forces_n.size(); ++i) {
      EXPECT_EQ(bench.device.forces_n[i], 0.0);
      EXPECT_FALSE(bench.device.enabled_at_write[i]);
    }
    EXPECT_EQ(bench.snapshot().newest.x().force_n, 0.0);
    EXPECT_EQ(bench.snapshot().newest.x().flags & kFlagDeviceFault, jumps ? kFlagDeviceFault : 0U);
    EXPECT_EQ(bench.snapshot().arming.note,
              jumps ? ArmingNote::kImplausible : ArmingNote::kRejected);
  }
}

}  // namespace
}  // namespace hapticwall::runtime
