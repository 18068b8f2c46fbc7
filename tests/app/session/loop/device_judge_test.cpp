// One report at a time.
#include "app/session/loop/device_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/app/session/loop/loop_bench.h"

namespace hapticwall::session {
namespace {

constexpr double kTickS = 1e-3;
constexpr double kCountM = 1e-4;
constexpr double kLimitN = 5.0;

class Judged : public ::testing::Test {
 protected:
  // The next report, a tick later by both clocks.
  ArmingNote at(double position_m, double device_step_s = kTickS, double host_step_s = kTickS) {
    reading.position_m = position_m;
    reading.device_time_s += device_step_s;
    return judge.judge(reading, link, {host_step_s, 0.0, kLimitN, false});
  }
  static device::DeviceInfo paddle() {
    device::DeviceInfo info;
    info.encoder_m = kCountM;
    info.motion = {-0.05, 0.06, 2.0, 0.1};
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

// 2 m/s, 5 % of the time, and three counts: 2.4 mm a tick.
TEST_F(Judged, TheSpeedIsByTheClockOfTheDevice) {
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.0020), ArmingNote::kNone);
  EXPECT_EQ(at(0.0044 - 1e-9), ArmingNote::kNone);
  EXPECT_EQ(at(0.0069), ArmingNote::kImplausible);
  EXPECT_EQ(at(0.0089), ArmingNote::kNone);  // the new place counts
  EXPECT_EQ(at(0.0129, 2e-3, kTickS), ArmingNote::kNone);
  EXPECT_EQ(at(0.0169, kTickS, 2e-3), ArmingNote::kImplausible);
}

TEST_F(Judged, WithoutAClockOfTheDeviceTheHostsCounts) {
  EXPECT_EQ(at(0.0, 0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.002, 0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.002, 0.0), ArmingNote::kNone);  // it reports at every third tick
  EXPECT_EQ(at(0.002, 0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.008, 0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.012, 0.0), ArmingNote::kImplausible);
}

// (5 + 50) N on 100 g: 0.55 m/s a tick; three counts at two ticks: 0.6 m/s.
TEST_F(Judged, TheSpeedChangesAsAHandAndTheForceCanChangeIt) {
  link.has_clock = true;
  for (const double side : {1.0, -1.0}) {
    judge.forget();
    EXPECT_EQ(at(0.0), ArmingNote::kNone);
    EXPECT_EQ(at(0.0), ArmingNote::kNone);
    EXPECT_EQ(at(side * 0.00115), ArmingNote::kNone);
    EXPECT_EQ(at(side * 0.0023), ArmingNote::kNone);
    EXPECT_EQ(at(side * 0.0022), ArmingNote::kAcceleration);
    EXPECT_EQ(at(side * 0.0022), ArmingNote::kNone);
    EXPECT_EQ(at(side * 0.0036), ArmingNote::kAcceleration) << "1.4 m/s are no speed too fast";
  }
}

TEST_F(Judged, AMissingReportAllowsMoreAccelerationAndAJitteringOneIsNone) {
  link.has_clock = true;
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.0026, 2e-3), ArmingNote::kNone);  // 1.3 m/s in 1.5 ms
  for (int i = 0; i < 20; ++i) {
    const double step_s = i % 2 == 0 ? 0.95e-3 : 1.05e-3;
    EXPECT_EQ(at(0.0039 + 0.0013 * i, step_s), ArmingNote::kNone);
  }
}

TEST_F(Judged, AJumpThatIsSlowerThanTheHandIsNoticedByItsAcceleration) {
  link.has_clock = true;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(at(0.01), ArmingNote::kNone);
  EXPECT_EQ(at(0.0119), ArmingNote::kAcceleration);
}

TEST_F(Judged, AClockThatRunsAheadHidesNoJump) {
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  EXPECT_EQ(at(0.05, 1.0), ArmingNote::kImplausible);  // 20 ms count at most: 42 mm
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
  EXPECT_EQ(at(0.0), ArmingNote::kSlowDevice);
  link.delay_s = 0.0201;
  EXPECT_EQ(at(0.0), ArmingNote::kSlowAnswer);
}

TEST_F(Judged, TheDelayMayGrowByThreeTicks) {
  link = {.connected = true,
          .applied_commands = 1,
          .delay_s = 1e-3,
          .recent_delay_s = 1e-3,
          .force_word = device::ForceWord::kSame};
  const auto answered_after = [&](double delay_s) {
    ++link.applied_commands;
    link.recent_delay_s = delay_s;
    return judge.judge(reading, link, {kTickS, 0.0, kLimitN, true});
  };
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(answered_after(i % 2 == 0 ? 1e-3 : 3.9e-3), ArmingNote::kNone);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(answered_after(4.1e-3), ArmingNote::kNone);
  EXPECT_EQ(answered_after(4.1e-3), ArmingNote::kSlowerAnswer);
}

TEST_F(Judged, APoorDelayIsRefusedAndAllowedOnRequest) {
  link = {.connected = true, .delay_s = 5.04e-3, .force_word = device::ForceWord::kSame};
  EXPECT_EQ(at(0.0), ArmingNote::kNone);
  link.delay_s = 5.06e-3;
  EXPECT_EQ(at(0.0), ArmingNote::kSlowDevice);
  DeviceJudge allows(paddle(), {.allow_slow_device = true});
  EXPECT_EQ(allows.judge(reading, link, {kTickS, 0.0, kLimitN, false}), ArmingNote::kNone);
}

// The position of a handle that moves at a constant speed says that no force slows it down.
TEST_F(Judged, AHandleThatGivesWayToTheFullForceShowsThatItDoesNotPush) {
  for (const int side : {1, -1}) {
    double along_m = 0.0;
    const auto at_full_force = [&](double speed_m_per_s, int ticks) {
      ArmingNote first = ArmingNote::kNone;
      for (int i = 0; i < ticks && first == ArmingNote::kNone; ++i) {
        along_m += speed_m_per_s * kTickS;
        reading.position_m = side * along_m;
        reading.device_time_s += kTickS;
        first = judge.judge(reading, link, {kTickS, side * kLimitN, kLimitN, true});
      }
      return first;
    };
    judge.forget();
    EXPECT_EQ(at_full_force(0.1, 79), ArmingNote::kNone);
    EXPECT_EQ(at_full_force(-0.1, 100), ArmingNote::kNone) << "the force moves it";
    EXPECT_EQ(at_full_force(0.1, 70), ArmingNote::kNone);
    EXPECT_EQ(at_full_force(0.1, 30), ArmingNote::kGivesWay);
    EXPECT_LT(along_m, 0.0079 - 0.01 + 0.0085);
    EXPECT_EQ(judge.judge(reading, link, {kTickS, 0.0, kLimitN, true}), ArmingNote::kNone);
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
  push_to(0.0625);
  EXPECT_EQ(bench.snapshot().newest.x().force_n, 5.0) << "a strong hand may do that";
  push_to(0.0638);
  EXPECT_EQ(bench.snapshot().newest.x().force_n, 0.0);
  EXPECT_EQ(bench.snapshot().arming.note, ArmingNote::kGivesWay);
}

// No command with force leaves in the tick of an objection, and the arming asks for an answer
// first.
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
}  // namespace hapticwall::session
