// Tests which nodes of a mocked machine are wheels, and what they take.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <umockdev.h>

#include <string>
#include <vector>

#include "device/port/wheel_node.h"

namespace hapticwall::device::evdev::testing {
namespace {

constexpr const char* kConstantForce = "100040000 0";  // constant force and a gain
constexpr const char* kRumbleOnly = "107030000 0";
constexpr const char* kInterface = "/devices/usb1/1-1/1-1:1.0";

class MockedWheels : public ::testing::Test {
 protected:
  void TearDown() override { g_object_unref(testbed_); }

  void add(const std::string& text) {
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_add_from_string(testbed_, text.c_str(), &error)) << error->message;
  }
  // `interval` of the OUT endpoint as the kernel writes it; empty: not on USB.
  std::vector<WheelListing> plugged(int vendor, int product, const std::string& interval,
                                    const char* effects = kConstantForce, int axes = 1) {
    add(fmt::format("P: {}\nE: SUBSYSTEM=usb\n", kInterface));
    if (!interval.empty()) {
      add(
          fmt::format("P: {0}/ep_81\nE: SUBSYSTEM=usb\nA: direction=in\\n\nA: interval=8ms\\n\n\n"
                      "P: {0}/ep_01\nE: SUBSYSTEM=usb\nA: direction=out\\n\nA: interval={1}\\n\n",
                      kInterface, interval));
    }
    add(
        fmt::format("P: {0}/hid\nE: SUBSYSTEM=hid\n\n"
                    "P: {0}/hid/input7\nE: SUBSYSTEM=input\nL: device=..\nA: name=A wheel\\n\n"
                    "A: uniq=\\n\nA: id/vendor={1:04x}\\n\nA: id/product={2:04x}\\n\n"
                    "A: capabilities/abs={3:x}\\n\nA: capabilities/ff={4}\\n\n\n"
                    "P: {0}/hid/input7/event7\nN: input/event7\nE: DEVNAME=/dev/input/event7\n"
                    "E: SUBSYSTEM=input\nL: device=../../input7\n",
                    kInterface, vendor, product, axes, effects));
    return list_wheels();
  }

  UMockdevTestbed* testbed_ = umockdev_testbed_new();
};

TEST_F(MockedWheels, AnEndpointLeavesATenthFree) {
  const auto wheels = plugged(0x1209, 0xFFB0, "1ms");
  ASSERT_EQ(wheels.size(), 1U);
  EXPECT_EQ(wheels[0].name, "A wheel");
  EXPECT_EQ(wheels[0].node.path(), "/dev/input/event7");
  EXPECT_DOUBLE_EQ(wheels[0].max_rate_hz, 900.0);
  EXPECT_TRUE(wheels[0].rate_is_known);
  EXPECT_EQ(wheels[0].refusal, "");
}

TEST_F(MockedWheels, AnUnknownEndpointIsSlow) {
  const auto wheels = plugged(0x1209, 0xFFB0, "");
  ASSERT_EQ(wheels.size(), 1U);
  EXPECT_DOUBLE_EQ(wheels[0].max_rate_hz, 125.0);
  EXPECT_FALSE(wheels[0].rate_is_known);
}

TEST_F(MockedWheels, AModelTakesLessThanItsEndpoint) {
  EXPECT_DOUBLE_EQ(plugged(0x346E, 0x0006, "1ms").at(0).max_rate_hz, 400.0);
}

TEST_F(MockedWheels, ASlowEndpointCountsBeforeTheModel) {
  EXPECT_DOUBLE_EQ(plugged(0x346E, 0x0006, "4ms").at(0).max_rate_hz, 225.0);
}

TEST_F(MockedWheels, AWheelThatQueuesIsRefused) {
  EXPECT_NE(plugged(0x046D, 0xC262, "1ms").at(0).refusal.find("HID++"), std::string::npos);
}

TEST_F(MockedWheels, ItsBrotherIsNot) {
  EXPECT_EQ(plugged(0x046D, 0xC24F, "1ms").at(0).refusal, "") << "a G29";
}

TEST_F(MockedWheels, AGamepadIsNoWheel) {
  EXPECT_TRUE(plugged(0x046D, 0xC262, "1ms", kRumbleOnly).empty());
}

TEST_F(MockedWheels, WithoutASteeringAxisItIsNone) {
  EXPECT_TRUE(plugged(0x046D, 0xC262, "1ms", kConstantForce, 2).empty());
}

}  // namespace
}  // namespace hapticwall::device::evdev::testing
