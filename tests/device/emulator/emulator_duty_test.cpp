// The emulated device fulfils the duties of docs/hid-protocol.md, tested by number. Duty 7 is in
// emulator_rejection_test.cpp, duty 10 in emulator_bus_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/device/emulator/emulator_support.h"

namespace hapticwall::device::hid {
namespace {

using testing::Bench;
using testing::kLimitN;
using testing::kMillisecondUs;
using testing::kPushN;
using testing::kTickUs;
using testing::kWatchdogMs;
using testing::one_axis;
using testing::two_axes;

TEST(EmulatorDuty, No1BeginWithoutForce) {
  Bench bench({{FaultKind::kUnplugged, 100 * kMillisecondUs, 10 * kMillisecondUs},
               {FaultKind::kRestart, 200 * kMillisecondUs, 10 * kMillisecondUs}});
  bench.ticks(50);
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_FALSE(bench.has(kStatusEnabled));
  bench.drive(kPushN, 49);
  EXPECT_EQ(bench.force_n(), kPushN);
  bench.ticks(20);  // off the bus, and back
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_EQ(bench.state.status, kStatusCalibrated);
  bench.drive(kPushN, 80);
  EXPECT_EQ(bench.force_n(), kPushN);
  bench.ticks(20);  // without power, and back
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_EQ(bench.state.status, 0);
  bench.drive(kPushN);
  EXPECT_EQ(bench.force_n(), kPushN);
}

TEST(EmulatorDuty, No2EnableCountsForOneCommand) {
  Bench bench;
  bench.tick();
  bench.drive(kPushN, 5);
  ForceReport without = bench.next_command(kPushN);
  without.enable = false;
  without.sequence = 2;  // neither its sequence nor its echo would do for a force
  without.echoed_state_sequence = 30000;
  bench.send(without);
  bench.tick();
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_FALSE(bench.has(kStatusEnabled));
  EXPECT_EQ(bench.state.rejected_commands, 0);
  EXPECT_EQ(bench.state.acknowledged_sequence, 2);
  bench.ticks(200);
  EXPECT_EQ(bench.state.status, kStatusCalibrated);  // no watchdog before the first command
}

// Nothing but a void report keeps the force.
TEST(EmulatorDuty, No2ACommandWithoutEnableIgnoresItsTimeToLiveAndItsForce) {
  struct Field {
    std::size_t at;
    std::array<std::uint8_t, 2> value;
  };
  constexpr Field kFields[] = {{6, {0, 0}}, {6, {101, 0}}, {8, {0xFF, 0x7F}}, {8, {0, 0x80}}};
  for (const Field& field : kFields) {
    Bench bench;
    bench.tick();
    bench.drive(kPushN, 5);
    ForceReport without = bench.next_command(kPushN);
    without.enable = false;
    ReportBytes bytes = encode_force(without);
    std::copy(field.value.begin(), field.value.end(), bytes.begin() + field.at);
    seal(bytes);
    ASSERT_TRUE(bench.device.write_output(bytes));
    bench.tick();
    EXPECT_EQ(bench.force_n(), 0.0) << field.at;
    EXPECT_EQ(bench.state.rejected_commands, 0) << field.at;
    EXPECT_EQ(bench.state.acknowledged_sequence, without.sequence) << field.at;
  }
}

TEST(EmulatorDuty, No3TimeToLive) {
  for (const int milliseconds : {1, 7, 20, 40}) {
    Bench bench;
    bench.tick();
    ForceReport command = bench.next_command(kPushN);
    command.time_to_live_ms = static_cast<std::uint16_t>(milliseconds);
    bench.step(500);
    bench.send(command);  // half a tick before the next one
    for (int i = 0; i < milliseconds; ++i) {
      bench.tick();
      ASSERT_EQ(bench.force_n(), kPushN) << milliseconds << ' ' << i;
    }
    bench.tick();
    EXPECT_EQ(bench.force_n(), 0.0) << milliseconds;
    EXPECT_EQ(bench.state.status, kStatusCalibrated);  // no fault
    bench.drive(kPushN);
    EXPECT_EQ(bench.force_n(), kPushN) << milliseconds;
  }
}

TEST(EmulatorDuty, No4Watchdog) {
  Bench bench;
  bench.tick();
  bench.push(kPushN);
  bench.ticks(kWatchdogMs - 1);
  EXPECT_FALSE(bench.has(kStatusWatchdog));
  bench.tick();
  EXPECT_TRUE(bench.has(kStatusWatchdog));
  EXPECT_EQ(bench.state.fault, kFaultWatchdog);
  EXPECT_EQ(bench.force_n(), 0.0);
  bench.drive(kPushN, 100);  // a host that continues unaware moves nothing
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_EQ(bench.state.acknowledged_sequence, bench.sequence);
  bench.clear_faults();
  bench.tick();
  EXPECT_EQ(bench.state.status, kStatusCalibrated);
  EXPECT_EQ(bench.state.fault, kNoFault);
  bench.drive(kPushN);
  EXPECT_EQ(bench.force_n(), kPushN);
}

TEST(EmulatorDuty, No4TheShorterOfWatchdogAndTimeToLiveEndsTheForce) {
  EmulatorSettings settings = one_axis();
  settings.watchdog_ms = 10;
  Bench bench(settings);
  bench.tick();
  bench.push(kPushN);  // for 20 ms
  bench.ticks(9);
  EXPECT_EQ(bench.force_n(), kPushN);
  bench.tick();
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_TRUE(bench.has(kStatusWatchdog));
}

TEST(EmulatorDuty, No5AWatchdogInHardware) {
  constexpr std::uint64_t kBeginUs = 100 * kMillisecondUs;
  Bench bench({{FaultKind::kFrozen, kBeginUs, 200 * kMillisecondUs}});
  bench.ticks(50);
  bench.drive(kPushN, 49);
  EXPECT_EQ(bench.force_n(), kPushN);
  const std::uint16_t before = bench.state.sequence;
  bench.drive(kPushN, kWatchdogMs - 1);
  EXPECT_FALSE(bench.device.accepts_output());
  EXPECT_EQ(bench.state.sequence, before);
  EXPECT_EQ(bench.force_n(), kPushN);  // it hangs and holds the force
  bench.tick();
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_FALSE(bench.device.is_plugged());
  bench.drive(kPushN, 151);  // back again; writes during the hang are lost
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_EQ(bench.state.status, 0);  // restarted: not calibrated either
  EXPECT_EQ(bench.state.sequence, 1);
  bench.drive(kPushN);
  EXPECT_EQ(bench.force_n(), kPushN);
}

TEST(EmulatorDuty, No5AShortHangEndsByTheTimeToLive) {
  Bench bench({{FaultKind::kFrozen, 100 * kMillisecondUs, 30 * kMillisecondUs}});
  bench.ticks(50);
  bench.drive(kPushN, 49);
  bench.ticks(31);
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_TRUE(bench.has(kStatusCalibrated));
}

TEST(EmulatorDuty, No6Clamp) {
  Bench bench(two_axes());
  bench.tick();
  for (const double sign : {1.0, -1.0}) {
    ForceReport command = bench.next_command(0.0);
    command.force_n = {sign * 30.0, sign * 5.001};
    bench.send(command);
    bench.tick();
    EXPECT_EQ(bench.device.amplifier_force_n()[0], sign * kLimitN);
    EXPECT_EQ(bench.device.amplifier_force_n()[1], sign * 5.0);
    EXPECT_TRUE(bench.has(kStatusSaturated));
    EXPECT_EQ(bench.state.applied_force_n[0], sign * kLimitN);
  }
  bench.drive(kLimitN);
  EXPECT_EQ(bench.force_n(), kLimitN);
  EXPECT_FALSE(bench.has(kStatusSaturated));
}

TEST(EmulatorDuty, No6AnAxisThatIsNotThereGetsNothing) {
  Bench bench;
  bench.tick();
  ForceReport command = bench.next_command(1.0);
  command.force_n[1] = 3.0;
  bench.send(command);
  bench.tick();
  EXPECT_EQ(bench.device.amplifier_force_n()[1], 0.0);
  EXPECT_EQ(bench.state.applied_force_n[1], 0.0);
  EXPECT_FALSE(bench.has(kStatusSaturated));
}

struct HardwareFault {
  FaultKind kind;
  std::uint16_t status;
  std::uint8_t code;
};
constexpr HardwareFault kHardwareFaults[] = {
    {FaultKind::kEmergencyStop, kStatusEmergencyStop, kFaultEmergencyStop},
    {FaultKind::kOverTemperature, kStatusOverTemperature, kFaultOverTemperature},
    {FaultKind::kOverCurrent, kStatusOverCurrent, kFaultOverCurrent},
    {FaultKind::kEncoderFault, kStatusEncoderFault, kFaultEncoder}};

TEST(EmulatorDuty, No8FaultsLast) {
  for (const HardwareFault& fault : kHardwareFaults) {
    Bench bench({{fault.kind, 100 * kMillisecondUs, 50 * kMillisecondUs}});
    bench.drive(kPushN, 99);
    EXPECT_EQ(bench.force_n(), kPushN);
    bench.drive(kPushN);
    EXPECT_EQ(bench.force_n(), 0.0);
    EXPECT_TRUE(bench.has(fault.status));
    EXPECT_EQ(bench.state.fault, fault.code);
    bench.clear_faults();  // while the cause is there
    bench.drive(kPushN, 20);
    EXPECT_TRUE(bench.has(fault.status));
    bench.drive(kPushN, 50);  // the cause is gone, the fault stays
    EXPECT_TRUE(bench.has(fault.status));
    EXPECT_EQ(bench.force_n(), 0.0);
    EXPECT_EQ(bench.state.acknowledged_sequence, bench.sequence);
    bench.clear_faults();
    bench.tick();
    EXPECT_EQ(bench.state.status, kStatusCalibrated);
    EXPECT_EQ(bench.state.fault, kNoFault);
    EXPECT_EQ(bench.force_n(), 0.0);  // a cleared fault is no command
    bench.drive(kPushN);
    EXPECT_EQ(bench.force_n(), kPushN);
  }
}

TEST(EmulatorDuty, No8TheFirstFaultIsNamedUntilItIsClearedAndThenOneThatIsLeft) {
  Bench bench({{FaultKind::kOverCurrent, 10 * kMillisecondUs, 5 * kMillisecondUs},
               {FaultKind::kOverTemperature, 12 * kMillisecondUs, 20 * kMillisecondUs}});
  bench.ticks(20);
  EXPECT_TRUE(bench.has(kStatusOverCurrent | kStatusOverTemperature));
  EXPECT_EQ(bench.state.fault, kFaultOverCurrent);
  bench.clear_faults();
  bench.tick();
  EXPECT_FALSE(bench.has(kStatusOverCurrent));
  EXPECT_TRUE(bench.has(kStatusOverTemperature));
  EXPECT_EQ(bench.state.fault, kFaultOverTemperature);
}

TEST(EmulatorDuty, No9EmergencyStopCutsThePowerAtOnce) {
  Bench bench({{FaultKind::kEmergencyStop, 100'300, 10 * kMillisecondUs},
               {FaultKind::kFrozen, 100'000, 40 * kMillisecondUs}});
  bench.drive(kPushN, 100);
  bench.step(299);
  EXPECT_EQ(bench.force_n(), kPushN);
  bench.step(1);  // between two ticks, while the firmware hangs
  EXPECT_EQ(bench.force_n(), 0.0);
}

TEST(EmulatorDuty, No11CalibratedOnlyWhileCountZeroIsWhereItShouldBe) {
  Bench bench({{FaultKind::kRestart, 100 * kMillisecondUs, 5 * kMillisecondUs}});
  bench.ticks(99);
  EXPECT_TRUE(bench.has(kStatusCalibrated));
  EXPECT_EQ(bench.state.position_counts[0], 118);
  bench.ticks(50);
  EXPECT_FALSE(bench.has(kStatusCalibrated));
  EXPECT_EQ(bench.state.position_counts[0], 0);
}

TEST(EmulatorDuty, No11TheForceTellsWhatTheAmplifiersAreTold) {
  Bench bench({{FaultKind::kOverTemperature, 100 * kMillisecondUs, 50 * kMillisecondUs}});
  for (int i = 0; i < 300; ++i) {
    if (i % 40 < 10) bench.push(12.0 * std::sin(i));
    bench.tick();
    ASSERT_EQ(bench.state.applied_force_n, bench.device.amplifier_force_n());
    ASSERT_EQ(bench.has(kStatusEnabled), i % 40 < 28 && i < 99) << i;
  }
}

TEST(EmulatorDuty, No12GoOnSpeaking) {
  Bench bench({{FaultKind::kEmergencyStop, 100 * kMillisecondUs, 900 * kMillisecondUs},
               {FaultKind::kNoOutput, 300 * kMillisecondUs, 100 * kMillisecondUs}});
  bench.ticks(2000);
  ASSERT_EQ(bench.reports.size(), 2000U);
  for (std::size_t i = 0; i < bench.reports.size(); ++i) {
    const auto decoded = decode_state(bench.reports[i].view());
    ASSERT_NE(decoded.report(), nullptr) << i;
    ASSERT_EQ(decoded.report()->sequence, i + 1);
    ASSERT_EQ(bench.reports[i].time_us, (i + 1) * kTickUs);
  }
}

}  // namespace
}  // namespace hapticwall::device::hid
