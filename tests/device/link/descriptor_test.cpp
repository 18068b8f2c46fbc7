// The report descriptor, read by the rules of HID 1.11, 6.2.2, promises what the codec does.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "device/link/report.h"

namespace hapticwall::device::hid {
namespace {

struct Descriptor {
  std::uint32_t usage_page = 0;
  std::uint32_t first_usage = 0;
  int open_collections = 0;
  std::map<std::uint32_t, std::string> kind_of_id;
  std::map<std::uint32_t, std::uint32_t> bits_of_id;
};

// Takes the items of a descriptor in order.
struct Parser {
  Descriptor all;
  std::uint32_t id = 0;
  std::uint32_t size = 0;
  std::uint32_t count = 0;

  void add_report(const char* kind, std::uint32_t value) {
    EXPECT_TRUE(all.kind_of_id.emplace(id, kind).second) << id;
    EXPECT_EQ(value, 2U);  // data, variable, absolute
    all.bits_of_id[id] += size * count;
  }

  // `item`: the prefix without its size.
  void take(unsigned item, std::uint32_t value) {
    switch (item) {
      case 0x04:
        all.usage_page = value;
        break;
      case 0x08:
        if (all.first_usage == 0) all.first_usage = value;
        break;
      case 0x74:
        size = value;
        break;
      case 0x94:
        count = value;
        break;
      case 0x84:
        id = value;
        break;
      case 0xA0:
        ++all.open_collections;
        break;
      case 0xC0:
        --all.open_collections;
        break;
      case 0x80:
        return add_report("input", value);
      case 0x90:
        return add_report("output", value);
      case 0xB0:
        return add_report("feature", value);
      default:
        EXPECT_TRUE(item == 0x14 || item == 0x24) << item;
    }
  }
};

// Short items only: prefix = tag << 4 | type << 2 | size.
Descriptor parsed() {
  Parser parser;
  for (std::size_t at = 0; at < kReportDescriptor.size();) {
    const unsigned prefix = kReportDescriptor.at(at++);
    const unsigned length = (prefix & 3U) == 3U ? 4U : prefix & 3U;
    std::uint32_t value = 0;
    for (unsigned i = 0; i < length; ++i) {
      value |= std::uint32_t{kReportDescriptor.at(at++)} << (8U * i);
    }
    parser.take(prefix & 0xFCU, value);
  }
  return parser.all;
}

TEST(HidDescriptor, PromisesTheThreeReports) {
  const Descriptor all = parsed();
  EXPECT_EQ(all.usage_page, kUsagePage);
  EXPECT_EQ(all.first_usage, kUsage);
  EXPECT_EQ(all.open_collections, 0);
  const std::map<std::uint32_t, std::string> expected{
      {kStateId, "input"}, {kForceId, "output"}, {kInfoId, "feature"}};
  EXPECT_EQ(all.kind_of_id, expected);
  for (const auto& [id, bits] : all.bits_of_id) EXPECT_EQ(bits, 8 * (kReportBytes - 1)) << id;
}

}  // namespace
}  // namespace hapticwall::device::hid
