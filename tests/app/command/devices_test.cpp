// hapticwall devices on an emulated bus.
#include "app/command/device/devices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/command/binary.h"
#include "tests/device/emulator/emulator_support.h"
#include "tests/device/link/link_fake_bus.h"

namespace hapticwall::command::test {
namespace {

using device::hid::testing::FakeBus;
using device::hid::testing::FakePort;
using device::hid::testing::one_axis;
using device::hid::testing::two_axes;
using device::hid::testing::usual_listing;

struct Desk {
  [[nodiscard]] DeviceList look() {
    const auto list = look_at_devices(port);
    EXPECT_TRUE(list);
    return *list;
  }
  [[nodiscard]] std::string text() { return device_list_text(look()); }

  FakeBus bus;
  FakePort port{bus};
};

TEST(DeviceList, AnEmptyDeskHasTheSimulator) {
  Desk desk;
  EXPECT_EQ(desk.text(), "sim  the simulator\n  usable\nno haptic device is connected\n");
}

TEST(DeviceList, AUsableDeviceIsNamedAsDeviceTakesItWithItsFigures) {
  Desk desk;
  desk.bus.add(usual_listing(), two_axes());
  EXPECT_THAT(desk.text(),
              HasSubstr("ie2000:/dev/hidraw0  1209:0001  Emulated device  serial 0001\n"
                        "  usable: 2 axes: 0.254 mm a count, 8.9 N; 0.254 mm a count, "
                        "5 N\n"));
  EXPECT_EQ(desk.bus.open_handles(), 0U) << "closed again";
  EXPECT_EQ(desk.bus.plugs()[0]->device.amplifier_force_n()[0], 0.0);
}

TEST(DeviceList, PrintsTheRuleIfPermissionIsMissing) {
  Desk desk;
  desk.bus.add(usual_listing(), one_axis()).denied = true;
  const std::string text = desk.text();
  EXPECT_THAT(text, HasSubstr("  not usable: /dev/hidraw0"));
  EXPECT_THAT(text, HasSubstr("/etc/udev/rules.d/70-hapticwall.rules"));
  EXPECT_THAT(text, HasSubstr("\nSUBSYSTEM==\"hidraw\", KERNELS==\"0003:1209:0001.*\""));
}

TEST(DeviceList, ADeviceOfAnotherHostIsListedAndLeftAlone) {
  Desk desk;
  desk.bus.add(usual_listing(), two_axes());
  FakePort session(desk.bus);
  ASSERT_TRUE(session.list());
  const auto handle = session.open("/dev/hidraw0");
  ASSERT_TRUE(handle);
  EXPECT_THAT(desk.text(), HasSubstr("serial 0001\n  not usable: /dev/hidraw0 is in use by another "
                                     "host: end that session first\n"));
  EXPECT_EQ(desk.bus.open_handles(), 1U);
}

TEST(DeviceList, ADeviceThatIsNotUnderstoodSaysWhy) {
  Desk desk;
  desk.bus.add(usual_listing("/dev/hidraw0"), one_axis()).feature_is_newer = true;
  device::hid::EmulatorSettings silent = one_axis();
  silent.has_info = false;
  desk.bus.add(usual_listing("/dev/hidraw1", "0002"), silent);
  const DeviceList list = desk.look();
  ASSERT_EQ(list.haptic.size(), 2U);
  for (const ListedDevice& device : list.haptic) {
    EXPECT_FALSE(device.description);
    EXPECT_THAT(device.problem, Not(HasSubstr("\n")));
    EXPECT_FALSE(device.problem.empty());
  }
  EXPECT_THAT(list.haptic[1].problem, HasSubstr("device file"));
  EXPECT_THAT(device_list_text(list), Not(HasSubstr("SUBSYSTEM")));
}

TEST(DeviceList, OtherHidDevicesAreCountedAndNotOpened) {
  Desk desk;
  auto keyboard = usual_listing("/dev/hidraw3");
  keyboard.usage_page = 1;
  keyboard.vendor_id = 0x046d;
  desk.bus.add(keyboard, one_axis()).denied = true;
  EXPECT_THAT(desk.text(), HasSubstr("1 other HID device ignored"));
  EXPECT_TRUE(desk.look().haptic.empty());
}

TEST(DeviceList, JsonHasEveryDeviceWithItsAxes) {
  Desk desk;
  desk.bus.add(usual_listing(), two_axes());
  desk.bus.add(usual_listing("/dev/hidraw1", "0002"), one_axis()).denied = true;
  const auto json = nlohmann::json::parse(device_list_json(desk.look()));
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["device"], "ie2000:/dev/hidraw0");
  EXPECT_EQ(json[0]["usable"], true);
  EXPECT_TRUE(json[0]["problem"].is_null());
  EXPECT_EQ(json[0]["axes"].size(), 2U);
  EXPECT_DOUBLE_EQ(json[0]["axes"][1]["force_limit_n"], 5.0);
  EXPECT_EQ(json[1]["usable"], false);
  EXPECT_EQ(json[1]["axes"].size(), 0U);
}

device::evdev::WheelListing wheel(std::string refusal) {
  return {device::evdev::NodeListing("event7"),
          "A wheel",
          0x1209,
          0xFFB0,
          900.0,
          true,
          std::move(refusal)};
}

TEST(DeviceList, AWheelIsListedWithWhatIsKnown) {
  DeviceList list;
  list.wheels = {wheel(""), wheel("it queues")};
  list.kernel_advice = "an old kernel";
  EXPECT_EQ(device_list_text(list),
            "sim  the simulator\n  usable\n"
            "ff:/dev/input/event7  1209:ffb0  A wheel\n"
            "  usable: at most 900 updates a second; its torque, travel and delay are unknown: a "
            "device file states them\n"
            "ff:/dev/input/event7  1209:ffb0  A wheel\n  not usable: it queues\n"
            "an old kernel\n");
  const auto json = nlohmann::json::parse(device_list_json(list));
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["device"], "ff:/dev/input/event7");
  EXPECT_EQ(json[0]["usable"], true);
  EXPECT_EQ(json[0]["kernel_advice"], "an old kernel");
  EXPECT_EQ(json[1]["problem"], "it queues");
}

// It answers on any machine, and leaves no files.
TEST_F(ProgramTest, DevicesAnswersOnAnyMachine) {
  const Answer answer = hapticwall({"devices"});
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("sim  the simulator"));
  EXPECT_TRUE(nlohmann::json::parse(hapticwall({"devices", "--json", "-"}).out).is_array());
}

}  // namespace
}  // namespace hapticwall::command::test
