// The emulated device with a host that starts late or is delayed.
#include <gtest/gtest.h>

#include "core/plant/plant_model.h"
#include "tests/device/emulator/emulator_support.h"

namespace hapticwall::device::hid {
namespace {

using testing::Bench;
using testing::kMillisecondUs;
using testing::kPushN;
using testing::kTickUs;
using testing::one_axis;

constexpr double kSpeedMPerS = 0.3;

// The hand is on its way from the first instant on.
EmulatorSettings moving_hand(bool waits) {
  EmulatorSettings settings = one_axis();
  settings.axes[0].x().hand->path = {{0.0, 0.03}, {1.0, 0.03 + kSpeedMPerS}};
  settings.hand_waits = waits;
  return settings;
}

TEST(EmulatorHand, GoesAtOnceWhereItIsNotToldToWait) {
  Bench bench(moving_hand(false));
  bench.ticks(300);
  EXPECT_GT(bench.device.truth(0).position_m, 0.04);
}

TEST(EmulatorHand, WaitsUntilTheDeviceIsEnabledForTheFirstTime) {
  Bench bench(moving_hand(true));
  bench.ticks(300);
  bench.send_without_enable();
  bench.ticks(300);
  EXPECT_EQ(bench.device.truth(0).position_m, 0.03);
  EXPECT_EQ(bench.state.sequence, 600);  // it is there, and speaks
  bench.drive(0.0, 300);
  EXPECT_GT(bench.device.truth(0).position_m, 0.04);
}

TEST(EmulatorHand, ARejectedCommandDoesNotStartIt) {
  Bench bench(moving_hand(true));
  bench.ticks(3);
  ForceReport command = bench.next_command(kPushN);
  command.time_to_live_ms = 0;
  bench.send(command);
  bench.ticks(300);
  EXPECT_EQ(bench.device.truth(0).position_m, 0.03);
}

TEST(EmulatorHand, DoesNotStandStillAgainWhenTheDeviceIsIdle) {
  Bench bench(moving_hand(true));
  bench.drive(0.0, 2);
  bench.send_without_enable();
  bench.ticks(300);
  EXPECT_FALSE(bench.has(kStatusEnabled));
  EXPECT_GT(bench.device.truth(0).position_m, 0.04);
}

// The first tick with force is the scene's tick 0, whenever that is.
TEST(EmulatorHand, ThenPlaysTheSceneFromItsStartTickByTick) {
  for (const int late : {1, 77}) {
    Bench bench(moving_hand(true));
    bench.ticks(late);
    bench.drive(-kPushN);
    ASSERT_TRUE(bench.has(kStatusEnabled));
    PlantModel plant(moving_hand(true).axes[0]);
    for (int i = 0; i < 200; ++i) {
      ASSERT_EQ(bench.device.truth(0).position_m, plant.truth().position_m) << i;
      bench.drive(-kPushN);
      plant.advance(kPushN);
    }
  }
}

TEST(EmulatorHold, NoReportGoesOutAndTheNextOneTells) {
  Bench bench;
  bench.ticks(2);
  bench.device.hold_reports(true);
  bench.ticks(3);
  EXPECT_EQ(bench.reports.size(), 2U);
  EXPECT_EQ(bench.device.state().sequence, 5);  // latched all the same
  bench.device.hold_reports(false);
  bench.tick();
  EXPECT_EQ(bench.state.sequence, 6);
  EXPECT_TRUE(bench.has(kStatusReportOverrun));
  bench.tick();
  EXPECT_FALSE(bench.has(kStatusReportOverrun));
}

TEST(EmulatorState, IsWhatTheLastTickLatchedSentOrNot) {
  Bench bench({{FaultKind::kSkipped, 3 * kTickUs, kMillisecondUs}});
  EXPECT_EQ(bench.device.state(), StateReport{});
  bench.ticks(2);
  EXPECT_EQ(bench.device.state(), bench.state);
  bench.tick();
  EXPECT_EQ(bench.state.sequence, 2);
  EXPECT_EQ(bench.device.state().sequence, 3);
}

}  // namespace
}  // namespace hapticwall::device::hid
