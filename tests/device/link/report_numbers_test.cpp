// Numbers of a report at the ends of their range: saturated forces, counters and clocks that wrap.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "device/link/report.h"

namespace hapticwall::device::hid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double through_force_report(double force_n) {
  ForceReport force{.enable = true};
  force.force_n = {force_n, 0.0};
  return decode_force(encode_force(force)).report()->force_n[0];
}

TEST(HidReport, AForceIsSaturatedBeforeItIsNarrowedAndNeverNan) {
  EXPECT_EQ(through_force_report(32.767), 32.767);
  EXPECT_EQ(through_force_report(32.768), 32.767);
  EXPECT_EQ(through_force_report(-32.768), -32.767);
  EXPECT_EQ(through_force_report(65.5), 32.767);
  EXPECT_EQ(through_force_report(1e300), 32.767);
  EXPECT_EQ(through_force_report(-1e300), -32.767);
  EXPECT_EQ(through_force_report(kNan), 0.0);
  EXPECT_EQ(through_force_report(kInfinity), 0.0);
  EXPECT_EQ(through_force_report(-kInfinity), 0.0);
  EXPECT_EQ(through_force_report(0.0004), 0.0);
  EXPECT_EQ(through_force_report(-0.0006), -0.001);
}

TEST(HidReport, OtherQuantitiesAreSaturatedToo) {
  StateReport state;
  state.minor_version = 200;
  state.status = 0xFFFF;
  state.temperature_c = 1e9;
  state.supply_v = -1.0;
  state.applied_force_n = {kNan, -1e9};
  const auto decoded = decode_state(encode_state(state));
  ASSERT_TRUE(decoded.report());
  EXPECT_EQ(decoded.report()->minor_version, 15);
  EXPECT_EQ(decoded.report()->status, kStatusKnown);
  EXPECT_EQ(decoded.report()->temperature_c, 327.67);
  EXPECT_EQ(decoded.report()->supply_v, 0.0);
  EXPECT_EQ(decoded.report()->applied_force_n[0], 0.0);
  EXPECT_EQ(decoded.report()->applied_force_n[1], -32.767);
  EXPECT_EQ(saturated_count(3e9), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(saturated_count(-kInfinity), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(saturated_count(kNan), 0);
  EXPECT_EQ(saturated_count(-2.6), -3);
}

TEST(HidClock, SequencesWrap) {
  EXPECT_EQ(sequence_step(7, 8), 1);
  EXPECT_EQ(sequence_step(8, 7), -1);
  EXPECT_EQ(sequence_step(5, 5), 0);
  EXPECT_EQ(sequence_step(65535, 0), 1);
  EXPECT_EQ(sequence_step(0, 65535), -1);
  EXPECT_EQ(sequence_step(65530, 10), 16);
  EXPECT_EQ(sequence_step(0, 32767), 32767);
  EXPECT_EQ(sequence_step(0, 32768), -32768);
}

TEST(HidClock, MicrosecondsWrap) {
  EXPECT_EQ(clock_step_us(1000, 3000), 2000);
  EXPECT_EQ(clock_step_us(0xFFFFFF00U, 0x100U), 0x200);
  EXPECT_EQ(clock_step_us(0x100U, 0xFFFFFF00U), -0x200);
}

TEST(HidClock, AWrappingClockIsUnwrappedForever) {
  constexpr std::int64_t kStepUs = 1'999'999'000;  // over half an hour
  std::int64_t true_us = 0xFFFF'0000;
  std::int64_t unwrapped = true_us;
  for (int i = 0; i < 1000; ++i) {
    true_us += kStepUs;
    unwrapped = unwrapped_us(unwrapped, static_cast<std::uint32_t>(true_us));
    ASSERT_EQ(unwrapped, true_us);
  }
  // A report that comes late is in the past, not an hour ahead.
  EXPECT_EQ(unwrapped_us(unwrapped, static_cast<std::uint32_t>(true_us - 5000)), true_us - 5000);
  EXPECT_EQ(unwrapped_us(10, 0xFFFFFFFFU), -1);
}

}  // namespace
}  // namespace hapticwall::device::hid
