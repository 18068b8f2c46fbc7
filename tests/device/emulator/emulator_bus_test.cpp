// Duty 10 of docs/hid-protocol.md: the emulated device loses its bus.
#include <gtest/gtest.h>

#include "tests/device/emulator/emulator_support.h"

namespace hapticwall::device::hid {
namespace {

using testing::Bench;
using testing::kMillisecondUs;
using testing::kPushN;
using testing::kTickUs;

TEST(EmulatorDuty, No10LossOfTheBus) {
  constexpr std::uint64_t kBeginUs = 100 * kMillisecondUs;
  Bench bench({{FaultKind::kUnplugged, kBeginUs, 500 * kMillisecondUs}});
  bench.drive(kPushN, 99);
  const std::size_t sent = bench.reports.size();
  bench.step(kTickUs);
  EXPECT_FALSE(bench.device.is_plugged());
  EXPECT_FALSE(bench.push(kPushN));
  EXPECT_FALSE(bench.device.get_feature(kInfoId));
  bench.ticks(3);
  EXPECT_EQ(bench.force_n(), 0.0);
  bench.ticks(500);
  EXPECT_EQ(bench.state.status, kStatusCalibrated);  // no fault
  EXPECT_EQ(bench.reports.size(), sent + 4);
  EXPECT_EQ(bench.state.sequence, 603);  // the sequence continued
  EXPECT_EQ(bench.state.time_us, 603'000U);
  EXPECT_EQ(bench.force_n(), 0.0);
}

// Their echo would be young enough when the bus is back.
TEST(EmulatorDuty, No10CommandsOnTheirWayAreDroppedWithTheBus) {
  for (const FaultKind kind : {FaultKind::kUnplugged, FaultKind::kRestart}) {
    Bench bench({{FaultKind::kSlow, 0, 1000 * kMillisecondUs, 1, 0.012},
                 {kind, 100 * kMillisecondUs, 6 * kMillisecondUs}});
    bench.drive(kPushN, 99);
    EXPECT_EQ(bench.force_n(), kPushN);
    bench.ticks(4);
    for (int i = 0; i < 30; ++i) {
      bench.tick();
      ASSERT_EQ(bench.force_n(), 0.0) << i;
    }
    EXPECT_EQ(bench.state.rejected_commands, 0) << "never judged";
  }
}

TEST(EmulatorDuty, No10AcknowledgementCountersAndFaultsOutliveTheBusAndNotTheRestart) {
  Bench bench({{FaultKind::kOverCurrent, 50 * kMillisecondUs, kMillisecondUs},
               {FaultKind::kUnplugged, 100 * kMillisecondUs, 10 * kMillisecondUs},
               {FaultKind::kRestart, 200 * kMillisecondUs, 10 * kMillisecondUs}});
  bench.drive(kPushN, 60);
  bench.device.write_output({});
  bench.ticks(39);
  const StateReport before = bench.state;
  EXPECT_EQ(before.acknowledged_sequence, 60);
  EXPECT_EQ(before.rejected_commands, 1);
  EXPECT_EQ(before.fault, kFaultOverCurrent);
  bench.ticks(30);
  EXPECT_EQ(bench.state.acknowledged_sequence, before.acknowledged_sequence);
  EXPECT_EQ(bench.state.acknowledged_time_us, before.acknowledged_time_us);
  EXPECT_EQ(bench.state.rejected_commands, before.rejected_commands);
  EXPECT_EQ(bench.state.fault, before.fault);
  EXPECT_EQ(bench.state.status, before.status);
  bench.ticks(100);
  EXPECT_EQ(bench.state.acknowledged_sequence, 0);
  EXPECT_EQ(bench.state.acknowledged_time_us, 0U);
  EXPECT_EQ(bench.state.rejected_commands, 0);
  EXPECT_EQ(bench.state.fault, kNoFault);
  EXPECT_EQ(bench.state.status, 0);
}

}  // namespace
}  // namespace hapticwall::device::hid
