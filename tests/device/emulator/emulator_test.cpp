// The emulated device in time and in space.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/device/emulator/emulator_support.h"

namespace hapticwall::device::hid {
namespace {

using testing::Bench;
using testing::kEncoderM;
using testing::kLimitN;
using testing::kMillisecondUs;
using testing::kPushN;
using testing::kTickUs;
using testing::kWatchdogMs;
using testing::one_axis;
using testing::two_axes;

TEST(EmulatorTiming, ACommandActsAtTheNextTickAndIsAcknowledged) {
  Bench bench;
  bench.ticks(3);
  bench.step(400);
  ASSERT_TRUE(bench.push(kPushN));
  EXPECT_EQ(bench.force_n(), 0.0);
  bench.tick();
  EXPECT_EQ(bench.force_n(), kPushN);
  EXPECT_EQ(bench.state.sequence, 4);
  EXPECT_EQ(bench.state.time_us, 4000U);
  EXPECT_EQ(bench.state.applied_force_n[0], kPushN);
  EXPECT_TRUE(bench.has(kStatusEnabled));
  EXPECT_EQ(bench.state.acknowledged_sequence, 1);
  EXPECT_EQ(bench.state.acknowledged_time_us, 3400U);
}

TEST(EmulatorTiming, TheLastCommandOfATickCounts) {
  Bench bench;
  bench.tick();
  bench.push(1.0);
  bench.push(3.0);
  bench.tick();
  EXPECT_EQ(bench.force_n(), 3.0);
}

TEST(EmulatorTiming, SequenceAndClockWrap) {
  Bench bench;
  bench.ticks(65535);
  EXPECT_EQ(bench.state.sequence, 65535);
  bench.push(kPushN);
  bench.tick();
  EXPECT_EQ(bench.state.sequence, 0);
  EXPECT_EQ(bench.force_n(), kPushN);  // the echo of 65535 is a tick old
  Firmware firmware(*decode_info(*bench.device.get_feature(kInfoId)).report());
  constexpr std::uint64_t kTurnUs = std::uint64_t{1} << 32U;
  firmware.tick(kTurnUs + 7, {});
  EXPECT_EQ(firmware.state(kTurnUs + 7).time_us, 7U);
}

TEST(EmulatorTiming, TheHostsSequenceMayWrapWhileDriven) {
  Bench bench;
  bench.sequence = 65500;
  bench.drive(kPushN, 100);
  EXPECT_EQ(bench.state.rejected_commands, 0);
  EXPECT_EQ(bench.state.acknowledged_sequence, 64);
  EXPECT_EQ(bench.force_n(), kPushN);
}

TEST(EmulatorTiming, AReportThatWasNotFetchedIsReplacedAndTheNextTells) {
  Bench bench({{FaultKind::kNotPolled, 10 * kMillisecondUs, 3 * kMillisecondUs}});
  bench.ticks(9);
  EXPECT_EQ(bench.reports.size(), 9U);
  bench.ticks(3);
  EXPECT_EQ(bench.reports.size(), 9U);
  bench.tick();
  EXPECT_EQ(bench.reports.size(), 10U);
  EXPECT_EQ(bench.state.sequence, 13);
  EXPECT_TRUE(bench.has(kStatusReportOverrun));
  bench.tick();
  EXPECT_FALSE(bench.has(kStatusReportOverrun));
}

TEST(EmulatorMechanics, APositiveForcePushesTowardsGrowingCounts) {
  for (const double sign : {1.0, -1.0}) {
    Bench bench;
    bench.tick();
    const std::int32_t start = bench.state.position_counts[0];
    EXPECT_EQ(start, std::lround(0.03 / kEncoderM));
    bench.drive(sign * kPushN, 20);
    EXPECT_GT(sign * (bench.state.position_counts[0] - start), 5);
    EXPECT_GT(sign * bench.state.velocity_counts_per_s[0], 0);
    bench.drive(sign * kPushN, 2000);  // 2 N against 250 N/m: 8 mm
    EXPECT_NEAR((bench.state.position_counts[0] - start) * kEncoderM, sign * kPushN / 250.0,
                kEncoderM);
  }
}

TEST(EmulatorMechanics, TheSecondAxisIsOneOfItsOwn) {
  Bench bench(two_axes());
  bench.tick();
  EXPECT_EQ(bench.state.position_counts[1], std::lround(-0.02 / kEncoderM));
  const std::int32_t first = bench.state.position_counts[0];
  for (int i = 0; i < 500; ++i) {
    ForceReport command = bench.next_command(0.0);
    command.force_n = {0.0, kPushN};
    bench.send(command);
    bench.tick();
  }
  EXPECT_EQ(bench.state.position_counts[0], first);
  EXPECT_GT(bench.state.position_counts[1], std::lround(-0.02 / kEncoderM) + 10);
}

TEST(EmulatorMechanics, InfoSaysWhatTheDeviceIs) {
  const Bench bench(two_axes());
  const auto decoded = decode_info(*bench.device.get_feature(kInfoId));
  const InfoReport* info = decoded.report();
  ASSERT_NE(info, nullptr);
  EXPECT_EQ(info->axes, 2);
  EXPECT_EQ(info->counts_per_metre[0], 3937);
  EXPECT_EQ(info->maximum_force_n[0], kLimitN);
  EXPECT_EQ(info->maximum_force_n[1], 5.0);
  EXPECT_EQ(info->tick_us, kTickUs);
  EXPECT_EQ(info->watchdog_ms, kWatchdogMs);
  EXPECT_FALSE(bench.device.get_feature(kStateId));
  EmulatorSettings mute = one_axis();
  mute.has_info = false;
  EXPECT_FALSE(FirmwareEmulator(mute).get_feature(kInfoId));
}

}  // namespace
}  // namespace hapticwall::device::hid
