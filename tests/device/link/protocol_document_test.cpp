// The bytes and offsets of docs/hid-protocol.md are those of the codec.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "device/link/report.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall::device::hid {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename Array>
Bytes bytes_of(const Array& array) {
  return Bytes(array.begin(), array.end());
}

std::string text_of(const Bytes& bytes) {
  constexpr std::size_t kInALine = 16;
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text += {kDigits[bytes[i] >> 4U], kDigits[bytes[i] & 15U]};
    text += (i + 1) % kInALine == 0 || i + 1 == bytes.size() ? '\n' : ' ';
  }
  return text;
}

std::vector<std::string> lines_of_document() {
  return hapticwall::test::lines_of(hapticwall::test::data_folder() + "/../docs/hid-protocol.md");
}

// The text between "```hex NAME" and "```".
std::map<std::string, std::string> examples_of_document() {
  const std::string begin = "```hex ";
  std::map<std::string, std::string> examples;
  std::string* open = nullptr;
  for (const std::string& line : lines_of_document()) {
    if (line.starts_with(begin)) {
      open = &examples[line.substr(begin.size())];
    } else if (line == "```") {
      open = nullptr;
    } else if (open != nullptr) {
      *open += line + '\n';
    }
  }
  return examples;
}

InfoReport info() {
  InfoReport info;
  info.axes = 2;
  info.flags = kInfoMeasuresVelocity | kInfoCalibrates;
  info.firmware = 0x00010000;
  info.counts_per_metre = {3937, 3937};
  info.maximum_force_n = {8.9, 8.9};
  info.tick_us = 1000;
  info.watchdog_ms = 50;
  return info;
}

StateReport idle() {
  StateReport state;
  state.sequence = 1000;
  state.time_us = 1'000'000;
  state.position_counts = {118, -20};
  state.status = kStatusCalibrated;
  state.temperature_c = 25.0;
  state.supply_v = 24.0;
  return state;
}

StateReport driven() {
  StateReport state = idle();
  state.sequence = 1001;
  state.time_us = 1'001'000;
  state.applied_force_n = {-1.5, 0.0};
  state.status = kStatusCalibrated | kStatusEnabled;
  state.acknowledged_sequence = 1;
  state.acknowledged_time_us = 1'000'400;
  return state;
}

StateReport stopped() {
  StateReport state = driven();
  state.sequence = 1051;
  state.time_us = 1'051'000;
  state.applied_force_n = {};
  state.status = kStatusCalibrated | kStatusWatchdog;
  state.fault = kFaultWatchdog;
  return state;
}

TEST(HidProtocolDocument, ItsBytesAreThoseOfTheCodec) {
  const ForceReport enabled{true, false, 1, 1000, 20, {-1.5, 0.0}};
  const ForceReport clear{false, true, 2, 1051, 20, {}};
  const std::map<std::string, Bytes> expected{{"descriptor", bytes_of(kReportDescriptor)},
                                              {"info", bytes_of(encode_info(info()))},
                                              {"state-idle", bytes_of(encode_state(idle()))},
                                              {"force-enabled", bytes_of(encode_force(enabled))},
                                              {"state-driven", bytes_of(encode_state(driven()))},
                                              {"state-watchdog", bytes_of(encode_state(stopped()))},
                                              {"force-clear", bytes_of(encode_force(clear))}};
  const auto shown = examples_of_document();
  EXPECT_EQ(shown.size(), expected.size());
  for (const auto& [name, bytes] : expected) {
    const auto found = shown.find(name);
    ASSERT_NE(found, shown.end()) << name;
    EXPECT_EQ(found->second, text_of(bytes)) << name;
  }
}

TEST(HidProtocolDocument, ItsRangesAreThoseOfTheCodec) {
  const auto range_to = [](auto most) { return ", 1 to " + std::to_string(most); };
  const std::string wanted[] = {"time to live, ms" + range_to(kMaxTimeToLiveMs),
                                "tick, µs" + range_to(kMaxTickUs),
                                "watchdog, ms" + range_to(kMaxTimeToLiveMs),
                                "first axis" + range_to(std::lround(kMaxForceN * kStepsPerNewton)),
                                "6 to " + std::to_string(kFirstOwnFault - 1) + " are reserved"};
  for (const std::string& words : wanted) {
    const auto lines = lines_of_document();
    EXPECT_TRUE(std::ranges::any_of(lines, [&](const std::string& line) {
      return line.find(words) != std::string::npos;
    })) << words;
  }
}

// The rows "| offset | bytes | ..." of the three reports follow each other up to byte 64.
TEST(HidProtocolDocument, ItsTablesLeaveNoByteOut) {
  std::size_t next = 0;
  int tables = 0;
  for (const std::string& line : lines_of_document()) {
    if (line == "| offset | bytes | type | |") {
      EXPECT_EQ(next, 0U) << "the table before ends early";
      ++tables;
      continue;
    }
    std::istringstream row(line);
    char bar = 0;
    char second_bar = 0;
    std::size_t offset = 0;
    std::size_t size = 0;
    row >> bar >> offset >> second_bar >> size;
    if (tables == 0 || !row || bar != '|' || second_bar != '|') continue;
    ASSERT_EQ(offset, next) << line;
    next = offset + size == kReportBytes ? 0 : offset + size;
  }
  EXPECT_EQ(tables, 3);
  EXPECT_EQ(next, 0U);
}

}  // namespace
}  // namespace hapticwall::device::hid
