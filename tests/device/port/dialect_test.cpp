// Raw reports of others, byte by byte.
#include "device/port/dialect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "device/link/stand_in.h"

namespace hapticwall::device::hid {
namespace {

using Raw = std::vector<std::uint8_t>;

ReportLayout one_field(FieldType type, double per_unit, double clamp = 0.0) {
  ReportLayout layout;
  layout.bytes = 6;
  layout.axes[0] = ReportField{1, type, per_unit, clamp};
  return layout;
}

double decoded(FieldType type, double per_unit, const Raw& bytes) {
  const auto position_m = decode_positions(one_field(type, per_unit), bytes);
  return position_m ? (*position_m)[0] : std::numeric_limits<double>::infinity();
}

TEST(Dialect, ReadsEveryTypeLittleEndian) {
  const Raw bytes{0xAA, 0x85, 0xFF, 0x02, 0xC0, 0xBB};
  EXPECT_EQ(decoded(FieldType::kI8, 1.0, bytes), -123.0);
  EXPECT_EQ(decoded(FieldType::kU8, 1.0, bytes), 133.0);
  EXPECT_EQ(decoded(FieldType::kI16, 1.0, bytes), -123.0);
  EXPECT_EQ(decoded(FieldType::kU16, 1.0, bytes), 65413.0);
  EXPECT_EQ(decoded(FieldType::kI32, 1.0, bytes), -1073545339.0);
  EXPECT_EQ(decoded(FieldType::kU32, 1.0, bytes), 3221421957.0);
  EXPECT_EQ(decoded(FieldType::kF32, 1.0, {0, 0x00, 0x00, 0x20, 0xC0, 0}), -2.5);
  EXPECT_EQ(decoded(FieldType::kI16, -0.5, bytes), 61.5);
  EXPECT_TRUE(std::isnan(decoded(FieldType::kF32, 1.0, {0, 0, 0, 0xC0, 0x7F, 0})));
}

TEST(Dialect, AnotherLengthOrIdIsNoReport) {
  ReportLayout layout = one_field(FieldType::kI16, 1.0);
  EXPECT_TRUE(decode_positions(layout, Raw(6)));
  for (const std::size_t size : {0U, 1U, 5U, 7U, 64U}) {
    EXPECT_FALSE(decode_positions(layout, Raw(size))) << size;
  }
  layout.id = 9;
  Raw bytes{9, 0xAA, 0x02, 0x01, 0, 0, 0};
  EXPECT_EQ((*decode_positions(layout, bytes))[0], 258.0);  // the offset counts behind the id
  bytes[0] = 8;
  EXPECT_FALSE(decode_positions(layout, bytes));
  EXPECT_FALSE(decode_positions(layout, Raw{}));
}

Raw encoded(const ReportLayout& layout, double force_n, bool enable = true) {
  ForceReport command;
  command.enable = enable;
  command.force_n[0] = force_n;
  const RawReport report = encode_forces(layout, command);
  return {report.view().begin(), report.view().end()};
}

TEST(Dialect, WritesEveryTypeBehindTheId) {
  EXPECT_EQ(encoded(one_field(FieldType::kI8, 0.1), 1.0), (Raw{0, 0, 10, 0, 0, 0, 0}));
  EXPECT_EQ(encoded(one_field(FieldType::kI16, 0.001), -1.0), (Raw{0, 0, 0x18, 0xFC, 0, 0, 0}));
  EXPECT_EQ(encoded(one_field(FieldType::kI32, -1e-6), 1.0),
            (Raw{0, 0, 0xC0, 0xBD, 0xF0, 0xFF, 0}));
  EXPECT_EQ(encoded(one_field(FieldType::kF32, 2.0), -5.0), (Raw{0, 0, 0, 0, 0x20, 0xC0, 0}));
  ReportLayout numbered = one_field(FieldType::kI8, 1.0);
  numbered.id = 7;
  EXPECT_EQ(encoded(numbered, 3.0), (Raw{7, 0, 3, 0, 0, 0, 0}));
}

TEST(Dialect, AForceIsClampedAndZeroWithoutEnable) {
  EXPECT_EQ(encoded(one_field(FieldType::kI8, 0.01), 5.0)[2], 127);
  EXPECT_EQ(encoded(one_field(FieldType::kI8, 0.01), -5.0)[2], 128);
  EXPECT_EQ(encoded(one_field(FieldType::kI8, 0.01, 50.0), 5.0)[2], 50);
  EXPECT_EQ(encoded(one_field(FieldType::kI8, 0.01, 50.0), -5.0)[2], 256 - 50);
  EXPECT_EQ(encoded(one_field(FieldType::kF32, 1.0), 5.0, false), Raw(7));
  EXPECT_EQ(encoded(one_field(FieldType::kF32, -1.0), 0.0), Raw(7));
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(encoded(one_field(FieldType::kI8, 0.01), bad), Raw(7));
    EXPECT_EQ(encoded(one_field(FieldType::kF32, 0.01), bad), Raw(7));
  }
}

class StandInTest : public ::testing::Test {
 protected:
  StateReport told(double position_m, std::int64_t now_us, const Told& more = {}) {
    const Decoded<StateReport> state =
        decode_state(stand_in.state({position_m, 0.0}, now_us * 1000, more));
    EXPECT_NE(state.report(), nullptr);
    return state.report() == nullptr ? StateReport{} : *state.report();
  }
  static ForceReport command(std::uint16_t sequence, double force_n) {
    ForceReport command;
    command.enable = true;
    command.sequence = sequence;
    command.force_n[0] = force_n;
    return command;
  }
  StandIn stand_in{{1e-4, 0.0}, 500'000};
};

TEST_F(StandInTest, CountsStatesAndTheirClock) {
  const StateReport first = told(0.0123, 70'000);
  EXPECT_EQ(first.position_counts[0], 123);
  EXPECT_EQ(first.time_us, 70'000U);
  const StateReport second = told(-0.0123, 71'000);
  EXPECT_EQ(second.position_counts[0], -123);
  EXPECT_EQ(second.sequence, first.sequence + 1);
  EXPECT_EQ(second.time_us, 71'000U);
  EXPECT_EQ(told(0.0, 71'001).time_us, 71'500U);  // they waited in a queue
  EXPECT_EQ(told(0.0, 72'100).time_us, 72'100U);
}

TEST_F(StandInTest, APositionThatIsNoNumberIsAFaultAndMovesNothing) {
  told(0.0123, 1000);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const StateReport state = told(bad, 2000);
    EXPECT_EQ(state.status & kStatusFaults, kStatusEncoderFault);
    EXPECT_EQ(state.position_counts[0], 123);
  }
  EXPECT_EQ(told(0.0123, 3000).status & kStatusFaults, 0);
  EXPECT_EQ(told(0.0123, 3000, {.fault = true}).fault, kFirstOwnFault);
  EXPECT_EQ(told(0.0123, 3000, {.calibrated = true}).status, kStatusCalibrated);
}

TEST_F(StandInTest, AcknowledgesWhatWasTaken) {
  told(0.0, 1000);
  stand_in.took(command(5, 1.5), 1'300'000);
  stand_in.refused();
  const StateReport state = told(0.0, 2000);
  EXPECT_EQ(state.acknowledged_sequence, 5);
  EXPECT_EQ(state.acknowledged_time_us, 1300U);
  EXPECT_EQ(state.applied_force_n[0], 1.5);
  EXPECT_EQ(state.status, kStatusEnabled);
  EXPECT_EQ(state.rejected_commands, 1);
  ForceReport off = command(6, 1.5);
  off.enable = false;
  stand_in.took(off, 2'000'000);
  EXPECT_EQ(told(0.0, 3000).applied_force_n[0], 0.0);
  EXPECT_EQ(told(0.0, 3000).status, 0);
}

TEST_F(StandInTest, TellsTheAnswerOfADeviceThatHasOne) {
  const StateReport state = told(0.0, 1000, {.answer = Told::Answer{9, true, -0.5}});
  EXPECT_EQ(state.acknowledged_sequence, 9);
  EXPECT_EQ(state.acknowledged_time_us, 1000U);
  EXPECT_EQ(state.applied_force_n[0], -0.5);
  EXPECT_EQ(state.status, kStatusEnabled);
  EXPECT_EQ(told(0.0, 2000, {.answer = Told::Answer{9, false, 0.0}}).acknowledged_time_us, 1000U);
}

}  // namespace
}  // namespace hapticwall::device::hid
