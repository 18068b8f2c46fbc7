// Tests which devices assets/70-hapticwall.rules opens to the user, by the rules of udev(7).
#include <fmt/format.h>
#include <fnmatch.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "device/link/report.h"
#include "embedded_rules.h"

namespace hapticwall {
namespace {

using Properties = std::map<std::string, std::string>;
using ::testing::IsEmpty;

// The hidraw node that the kernel makes, with the name of its parent (KERNELS).
Properties hidraw(int vendor, int product, const std::string& bus = "0003") {
  return {{"SUBSYSTEM", "hidraw"},
          {"KERNELS", fmt::format("{}:{:04X}:{:04X}.0007", bus, vendor, product)}};
}

Properties usb(int vendor, int product, const std::string& type = "usb_device") {
  return {{"SUBSYSTEM", "usb"},
          {"ENV{DEVTYPE}", type},
          {"ATTR{idVendor}", fmt::format("{:04x}", vendor)},
          {"ATTR{idProduct}", fmt::format("{:04x}", product)}};
}

// Properties that the rules assign to a device: those of every line whose `==` all hold.
Properties assigned(const Properties& device) {
  static const std::regex kPair(R"re(([A-Za-z{}]+)(==|\+=|=)"([^"]*)"(?:, |$))re");
  Properties all;
  std::istringstream lines{std::string(embedded_rules().front().bytes)};
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    Properties of_line;
    bool holds = true;
    std::size_t read = 0;
    for (std::sregex_iterator pair(line.begin(), line.end(), kPair), end; pair != end; ++pair) {
      const std::string key = (*pair)[1];
      const std::string value = (*pair)[3];
      read += static_cast<std::size_t>(pair->length());
      if ((*pair)[2] != "==") {
        of_line[key] = value;
      } else {
        const auto found = device.find(key);
        holds =
            holds && found != device.end() && fnmatch(value.c_str(), found->second.c_str(), 0) == 0;
      }
    }
    EXPECT_EQ(read, line.size()) << "not key, operator and value: " << line;
    if (holds) all.merge(of_line);
  }
  return all;
}

TEST(UdevRules, OpenTheDeviceToTheSeatAndTheGroupAndNobodyElse) {
  const Properties wanted{{"TAG", "uaccess"}, {"GROUP", "plugdev"}, {"MODE", "0660"}};
  EXPECT_EQ(assigned(hidraw(device::hid::kTestVendorId, device::hid::kTestProductId)), wanted);
  EXPECT_EQ(assigned(usb(device::hid::kTestVendorId, device::hid::kTestProductId)), wanted);
}

TEST(UdevRules, LeaveEveryOtherDeviceAlone) {
  constexpr int kVendor = device::hid::kTestVendorId;
  constexpr int kProduct = device::hid::kTestProductId;
  for (const Properties& other :
       {hidraw(kVendor, kProduct + 1), hidraw(kVendor + 1, kProduct),
        hidraw(kVendor, kProduct, "0005"), usb(kVendor, kProduct + 1), usb(kVendor + 1, kProduct),
        usb(kVendor, kProduct, "usb_interface"), Properties{}}) {
    EXPECT_THAT(assigned(other), IsEmpty());
  }
}

}  // namespace
}  // namespace hapticwall
