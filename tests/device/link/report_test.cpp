#include "device/link/report.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <string_view>
#include <vector>

namespace hapticwall::device::hid {
namespace {

constexpr std::size_t kCrcAt = 62;

StateReport some_state() {
  StateReport state;
  state.sequence = 0x1234;
  state.time_us = 0x89ABCDEF;
  state.position_counts = {-2, 0x01020304};
  state.velocity_counts_per_s = {std::numeric_limits<std::int32_t>::min(), 7};
  state.applied_force_n = {-1.5, 8.9};
  state.status = kStatusEnabled | kStatusReportOverrun;
  state.acknowledged_sequence = 0xFFFE;
  state.acknowledged_time_us = 0x00C0FFEE;
  state.buttons = 0x81;
  state.fault = kFaultWatchdog;
  state.temperature_c = -3.25;
  state.supply_v = 24.001;
  state.rejected_commands = 513;
  return state;
}

ForceReport some_force() { return {true, false, 0x0102, 0xFFFF, kUsualTimeToLiveMs, {-8.9, 0.25}}; }

InfoReport some_info() {
  InfoReport info;
  info.axes = 2;
  info.flags = kInfoMeasuresVelocity;
  info.firmware = 0x00010203;
  info.counts_per_metre = {3937, 49261};
  info.maximum_force_n = {8.9, 5.0};
  info.tick_us = 1000;
  info.watchdog_ms = 50;
  return info;
}

// Changes a byte, and makes the CRC right again.
ReportBytes with(ReportBytes bytes, std::size_t at, std::uint8_t value) {
  bytes.at(at) = value;
  seal(bytes);
  return bytes;
}

template <typename Report>
const Refusal* refused(const Decoded<Report>& decoded) {
  EXPECT_NE(decoded.report() == nullptr, decoded.refusal() == nullptr);
  return decoded.refusal();
}
#define EXPECT_REFUSED(decoded, why)     \
  do {                                   \
    const auto answer = (decoded);       \
    ASSERT_NE(refused(answer), nullptr); \
    EXPECT_EQ(*answer.refusal(), why);   \
  } while (false)

TEST(HidCrc, IsTheKnownOne) {
  constexpr std::string_view kCheck = "123456789";
  const std::vector<std::uint8_t> bytes(kCheck.begin(), kCheck.end());
  EXPECT_EQ(crc16(bytes), 0x29B1);
  EXPECT_EQ(crc16({}), 0xFFFF);
}

TEST(HidReport, StateHasTheseBytes) {
  const ReportBytes bytes = encode_state(some_state());
  const std::vector<std::uint8_t> expected{
      0x01, 0x10, 0x34, 0x12, 0xEF, 0xCD, 0xAB, 0x89,              // id, protocol, sequence, time
      0xFE, 0xFF, 0xFF, 0xFF, 0x04, 0x03, 0x02, 0x01,              // counts
      0x00, 0x00, 0x00, 0x80, 0x07, 0x00, 0x00, 0x00,              // counts a second
      0x24, 0xFA, 0xC4, 0x22, 0x01, 0x02, 0xFE, 0xFF,              // force, status, acknowledged
      0xEE, 0xFF, 0xC0, 0x00, 0x81, 0x01, 0xBB, 0xFE, 0xC1, 0x5D,  // its time ... supply
      0x01, 0x02};                                                 // rejected
  EXPECT_EQ(std::vector(bytes.begin(), bytes.begin() + 44), expected);
  EXPECT_EQ(std::accumulate(bytes.begin() + 44, bytes.begin() + kCrcAt, 0), 0);
  const std::uint16_t crc = crc16(std::span(bytes).first(kCrcAt));
  EXPECT_EQ(bytes[62], crc & 0xFFU);
  EXPECT_EQ(bytes[63], crc >> 8U);
}

TEST(HidReport, ForceHasTheseBytes) {
  const ReportBytes bytes = encode_force(some_force());
  const std::vector<std::uint8_t> expected{0x02, 0x01, 0x02, 0x01, 0xFF, 0xFF,
                                           0x14, 0x00, 0x3C, 0xDD, 0xFA, 0x00};
  EXPECT_EQ(std::vector(bytes.begin(), bytes.begin() + 12), expected);
  EXPECT_EQ(std::accumulate(bytes.begin() + 12, bytes.begin() + kCrcAt, 0), 0);
  EXPECT_EQ(encode_force({false, true, 0, 0, 1, {}})[1], 0x02);
}

TEST(HidReport, InfoHasTheseBytes) {
  const ReportBytes bytes = encode_info(some_info());
  const std::vector<std::uint8_t> expected{0x03, 0x10, 0x02, 0x01, 0x03, 0x02, 0x01, 0x00,
                                           0x61, 0x0F, 0x00, 0x00, 0x6D, 0xC0, 0x00, 0x00,
                                           0xC4, 0x22, 0x88, 0x13, 0xE8, 0x03, 0x32, 0x00};
  EXPECT_EQ(std::vector(bytes.begin(), bytes.begin() + 24), expected);
  EXPECT_EQ(std::accumulate(bytes.begin() + 24, bytes.begin() + kCrcAt, 0), 0);
}

// Two bits at a time: the CRC detects every such error in a report of this length.
TEST(HidReport, EveryFlippedBitIsRefused) {
  const ReportBytes state = encode_state(some_state());
  const ReportBytes force = encode_force(some_force());
  const ReportBytes info = encode_info(some_info());
  constexpr std::size_t kBits = kReportBytes * 8;
  const auto flipped = [](ReportBytes bytes, std::size_t one, std::size_t other) {
    bytes.at(one / 8) ^= static_cast<std::uint8_t>(1U << (one % 8));
    if (other != one) bytes.at(other / 8) ^= static_cast<std::uint8_t>(1U << (other % 8));
    return bytes;
  };
  for (std::size_t one = 0; one < kBits; ++one) {
    for (std::size_t other = one; other < kBits; ++other) {
      ASSERT_TRUE(decode_state(flipped(state, one, other)).refusal()) << one << ' ' << other;
      ASSERT_TRUE(decode_force(flipped(force, one, other)).refusal()) << one << ' ' << other;
      ASSERT_TRUE(decode_info(flipped(info, one, other)).refusal()) << one << ' ' << other;
    }
  }
}

TEST(HidReport, OneLengthOnlyIsRead) {
  const ReportBytes state = encode_state(some_state());
  std::vector<std::uint8_t> bytes(state.begin(), state.end());
  bytes.resize(80);
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    const std::span<const std::uint8_t> view = std::span(bytes).first(size);
    if (size == kReportBytes) {
      EXPECT_TRUE(decode_state(view).report());
    } else {
      EXPECT_REFUSED(decode_state(view), Refusal::kLength);
      EXPECT_REFUSED(decode_force(view), Refusal::kLength);
      EXPECT_REFUSED(decode_info(view), Refusal::kLength);
    }
  }
}

TEST(HidReport, AnotherIdIsRefused) {
  EXPECT_REFUSED(decode_state(ReportBytes{}), Refusal::kId);  // all zero
  EXPECT_REFUSED(decode_state(encode_force(some_force())), Refusal::kId);
  EXPECT_REFUSED(decode_force(encode_state(some_state())), Refusal::kId);
  EXPECT_REFUSED(decode_info(with(encode_info(some_info()), 0, 0x04)), Refusal::kId);
}

TEST(HidReport, AWrongCrcIsRefused) {
  ReportBytes bytes = encode_state(some_state());
  bytes[63] ^= 1U;
  EXPECT_REFUSED(decode_state(bytes), Refusal::kCrc);
  ReportBytes no_crc = encode_force(some_force());
  no_crc[62] = no_crc[63] = 0;
  EXPECT_REFUSED(decode_force(no_crc), Refusal::kCrc);
}

TEST(HidReport, AnotherMajorVersionIsRefusedAndANewerMinorOneIsNot) {
  for (unsigned version = 0; version < 256; ++version) {
    const auto byte = static_cast<std::uint8_t>(version);
    const auto state = decode_state(with(encode_state(some_state()), 1, byte));
    const auto info = decode_info(with(encode_info(some_info()), 1, byte));
    if (version >> 4U == kProtocolMajor) {
      ASSERT_TRUE(state.report() && info.report()) << version;
      EXPECT_EQ(state.report()->minor_version, version & 0x0FU);
      EXPECT_EQ(info.report()->minor_version, version & 0x0FU);
    } else {
      EXPECT_REFUSED(state, Refusal::kProtocol);
      EXPECT_REFUSED(info, Refusal::kProtocol);
    }
  }
}

TEST(HidReport, ReservedBitsAreZeroInThisMinorVersion) {
  for (std::size_t at = 44; at < kCrcAt; ++at) {
    EXPECT_REFUSED(decode_state(with(encode_state(some_state()), at, 0x10)), Refusal::kReserved);
  }
  for (std::size_t at = 12; at < kCrcAt; ++at) {
    EXPECT_REFUSED(decode_force(with(encode_force(some_force()), at, 0x01)), Refusal::kReserved);
  }
  for (std::size_t at = 24; at < kCrcAt; ++at) {
    EXPECT_REFUSED(decode_info(with(encode_info(some_info()), at, 0x80)), Refusal::kReserved);
  }
  for (const unsigned shift : {2U, 3U, 4U, 5U, 6U, 7U}) {
    const auto bit = static_cast<std::uint8_t>(1U << shift);
    EXPECT_REFUSED(decode_state(with(encode_state(some_state()), 29, bit)), Refusal::kReserved);
    EXPECT_REFUSED(decode_force(with(encode_force(some_force()), 1, bit)), Refusal::kReserved);
    EXPECT_REFUSED(decode_info(with(encode_info(some_info()), 3, bit)), Refusal::kReserved);
  }
}

TEST(HidReport, AdditionsOfANewerMinorVersionAreNotHandedOn) {
  ReportBytes newer = encode_state(some_state());
  newer[1] = 0x11;
  newer[29] |= 0x80;  // an unknown status bit
  const auto state = decode_state(with(newer, 50, 0xAA));
  ASSERT_TRUE(state.report());
  EXPECT_EQ(state.report()->status, some_state().status);
}

TEST(HidReport, ACommandsTimeToLiveHasARange) {
  for (const int milliseconds : {1, 20, 100}) {
    const auto bytes = with(encode_force(some_force()), 6, static_cast<std::uint8_t>(milliseconds));
    EXPECT_TRUE(decode_force(bytes).report()) << milliseconds;
  }
  for (const int milliseconds : {0, 101, 255}) {
    const auto bytes = with(encode_force(some_force()), 6, static_cast<std::uint8_t>(milliseconds));
    EXPECT_REFUSED(decode_force(bytes), Refusal::kValue);
  }
  const auto no_force = with(with(encode_force(some_force()), 8, 0x00), 9, 0x80);
  EXPECT_REFUSED(decode_force(no_force), Refusal::kValue);
  ForceReport force = some_force();
  force.time_to_live_ms = 0;
  EXPECT_EQ(encode_force(force)[6], 1);
  force.time_to_live_ms = 65535;
  EXPECT_EQ(encode_force(force)[6], 100);
  EXPECT_EQ(encode_force(force)[7], 0);
}

// It removes the force: nothing that it does not need may make it void.
TEST(HidReport, ACommandWithoutEnableNeedsNoTimeToLiveAndNoForce) {
  ForceReport command = some_force();
  command.enable = false;
  command.clear_faults = true;
  const ReportBytes sound = encode_force(command);
  ASSERT_TRUE(decode_force(sound).report());
  EXPECT_EQ(*decode_force(sound).report(), command);
  command.time_to_live_ms = kUsualTimeToLiveMs;
  command.force_n = {};
  for (const auto& bytes : {with(sound, 6, 0), with(sound, 6, 101), with(sound, 7, 0xFF),
                            with(with(sound, 10, 0x00), 11, 0x80)}) {
    ASSERT_TRUE(decode_force(bytes).report());
    EXPECT_EQ(*decode_force(bytes).report(), command);
  }
}

TEST(HidReport, ADeviceThatMakesNoSenseIsRefused) {
  const auto refuse = [](auto change) {
    InfoReport info = some_info();
    change(info);
    EXPECT_REFUSED(decode_info(encode_info(info)), Refusal::kValue);
  };
  refuse([](InfoReport& info) { info.axes = 0; });
  refuse([](InfoReport& info) { info.axes = 3; });
  refuse([](InfoReport& info) { info.axes = 1; });  // with values of a second axis
  refuse([](InfoReport& info) { info.tick_us = 0; });
  refuse([](InfoReport& info) { info.tick_us = 20'000; });  // no link would last
  refuse([](InfoReport& info) { info.watchdog_ms = 0; });
  refuse([](InfoReport& info) { info.watchdog_ms = 101; });
  for (const std::size_t axis : {0U, 1U}) {
    refuse([&](InfoReport& info) { info.counts_per_metre.at(axis) = 0; });
    refuse([&](InfoReport& info) { info.counts_per_metre.at(axis) = -3937; });
    refuse([&](InfoReport& info) { info.maximum_force_n.at(axis) = 0.0; });
    refuse([&](InfoReport& info) { info.maximum_force_n.at(axis) = -8.9; });
  }
  InfoReport one_axis = some_info();
  one_axis.axes = 1;
  one_axis.counts_per_metre[1] = 0;
  one_axis.maximum_force_n[1] = 0.0;
  EXPECT_TRUE(decode_info(encode_info(one_axis)).report());
  one_axis.tick_us = 19'999;
  EXPECT_TRUE(decode_info(encode_info(one_axis)).report());
}

TEST(HidReport, EveryRefusalHasWordsOfItsOwn) {
  constexpr Refusal kAll[] = {Refusal::kLength,   Refusal::kId,       Refusal::kCrc,
                              Refusal::kProtocol, Refusal::kReserved, Refusal::kValue};
  for (const Refusal one : kAll) {
    EXPECT_FALSE(refusal_text(one).empty());
    for (const Refusal other : kAll) {
      EXPECT_EQ(refusal_text(one) == refusal_text(other), one == other);
    }
  }
}

}  // namespace
}  // namespace hapticwall::device::hid
