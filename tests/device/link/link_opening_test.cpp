// The choice of a device, its description, and the message if it is unusable.
#include <gtest/gtest.h>

#include <string>

#include "tests/device/link/link_rig.h"

namespace hapticwall::device {
namespace {

using hid::testing::usual_listing;
using testing::Rig;
using testing::VirtualHost;

constexpr int kLongEnough = 2000;  // ticks; enough for all attempts of an opening

// The words of an opening that fails.
std::string failure_of(Rig& rig) {
  EXPECT_TRUE(rig.host.ticks_until([&] { return rig.host.owner.opening() != Opening::kPending; },
                                   kLongEnough));
  EXPECT_EQ(rig.host.owner.opening(), Opening::kFailed);
  rig.host.ticks(5);  // time to close what was opened
  EXPECT_EQ(rig.bus.open_handles(), 0U);
  EXPECT_EQ(rig.host.last.state, DeviceState::kFault);
  EXPECT_EQ(rig.force_n(), 0.0);
  return rig.host.owner.words();
}

TEST(LinkOpening, NothingConnected) {
  Rig rig;
  rig.plug.hidden = true;
  EXPECT_EQ(failure_of(rig),
            "no haptic device is connected; 'hapticwall devices' lists the connected devices");
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kNotFound);
  EXPECT_EQ(rig.bus.lists, kAttemptsToOpen);
}

TEST(LinkOpening, NothingOfThatKindConnected) {
  ImpulseEngineOptions options;
  options.vendor_id = 0x16c0;
  options.product_id = 0x0486;
  options.serial = "7";
  options.path = "/dev/hidraw5";
  Rig rig({}, options);
  EXPECT_EQ(failure_of(rig),
            "no haptic device 16c0:0486 with the serial number 7 at /dev/hidraw5 is connected; "
            "'hapticwall devices' lists the connected devices");
}

TEST(LinkOpening, PermissionRefusedNamesThePathAndTheRuleAndThenGranted) {
  Rig rig;
  rig.plug.denied = true;
  EXPECT_EQ(failure_of(rig),
            "/dev/hidraw0 cannot be opened: permission denied; install the udev rule "
            "70-hapticwall.rules, then plug the device in again");
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kRefused);
  rig.plug.denied = false;
  EXPECT_TRUE(rig.host.come_up());
}

TEST(LinkOpening, PermissionRefusedAfterAReplug) {
  Rig rig;
  rig.drive_until_ms(100);
  rig.replug();
  rig.plug.denied = true;
  rig.host.ticks(1200);
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kRefused);
  EXPECT_NE(rig.host.owner.words().find("70-hapticwall.rules"), std::string::npos);
  EXPECT_EQ(rig.host.owner.opening(), Opening::kUp);  // that was long ago and stays
  rig.plug.denied = false;
  EXPECT_TRUE(rig.host.come_up());
  EXPECT_EQ(rig.host.owner.words(), "");
  EXPECT_EQ(rig.force_n(), 0.0);
}

hid::EmulatorSettings without_info() {
  hid::EmulatorSettings settings = hid::testing::one_axis();
  settings.has_info = false;
  return settings;
}

TEST(LinkOpening, SaysWhyADeviceIsNoneOfTheProtocol) {
  constexpr std::uint64_t kForEver = 1'000'000'000;
  ImpulseEngineOptions described;
  described.axes[0] = AxisDescription{1e-4, 5.0};
  Rig void_info;
  void_info.plug.feature_is_void = true;
  EXPECT_EQ(failure_of(void_info),
            "/dev/hidraw0 gives an INFO report that is void (wrong CRC): its firmware has to "
            "follow docs/hid-protocol.md");
  Rig newer({}, described);
  newer.plug.feature_is_newer = true;
  EXPECT_EQ(failure_of(newer),
            "/dev/hidraw0 speaks version 2 of the protocol, this program speaks version 1: "
            "update the older of the two");
  EXPECT_EQ(newer.host.stats().trouble, Trouble::kRefused);
  Rig mute({}, {}, without_info());
  EXPECT_EQ(failure_of(mute),
            "/dev/hidraw0 does not describe itself (no INFO report): name a device file that "
            "does");
  Rig silent({{hid::FaultKind::kSilent, 0, kForEver}});
  EXPECT_EQ(failure_of(silent), "/dev/hidraw0 was opened, but sends nothing");
  Rig void_reports({{hid::FaultKind::kWrongMajor, 0, kForEver}});
  EXPECT_EQ(failure_of(void_reports),
            "/dev/hidraw0 sends reports, but none is a STATE of the protocol");
  EXPECT_GT(void_reports.host.stats().void_reports, 100U);
  EXPECT_EQ(void_reports.host.stats().states, 0U);
}

TEST(LinkOpening, ADeviceFileDescribesIt) {
  ImpulseEngineOptions options;
  options.name = "My paddle";
  options.axes[0] = AxisDescription{0.3e-3, 5.0};
  Rig rig({}, options, without_info());
  ASSERT_TRUE(rig.host.come_up());
  const auto described = rig.host.owner.description();
  ASSERT_TRUE(described);
  EXPECT_EQ(described->name, "My paddle");
  EXPECT_EQ(described->axes, 1U);
  EXPECT_FALSE(described->describes_itself);
  EXPECT_EQ(described->axis[0], (AxisDescription{0.3e-3, 5.0}));
  EXPECT_DOUBLE_EQ(rig.host.last.position_m[0], 118 * 0.3e-3);
}

TEST(LinkOpening, TheFilesEncoderWinsAndTheSmallerForce) {
  for (const double limit_n : {5.0, 20.0}) {
    ImpulseEngineOptions options;
    options.axes[0] = AxisDescription{0.25e-3, limit_n};
    Rig rig({}, options, hid::testing::two_axes());
    ASSERT_TRUE(rig.host.come_up());
    const auto described = rig.host.owner.description();
    EXPECT_EQ(described->axes, 2U);
    EXPECT_EQ(described->axis[0], (AxisDescription{0.25e-3, std::min(limit_n, 8.9)}));
    EXPECT_EQ(described->axis[1], (AxisDescription{1.0 / 3937.0, 5.0}));  // the device's own values
    EXPECT_EQ(described->name, "Emulated device");
  }
}

// Up to 10 N a law is felt as it is; a stronger device needs 2 ms to its limit, or as its file
// says.
TEST(LinkOpening, AStrongDeviceRaisesItsForceInTwoMilliseconds) {
  for (const double limit_n : {8.9, 20.0}) {
    for (const double rate : {0.0, 500.0}) {
      hid::testing::FakeBus bus;
      hid::EmulatorSettings settings = hid::testing::one_axis();
      settings.axes[0].x().device.force_limit_n = limit_n;
      bus.add(hid::testing::usual_listing(), settings);
      hid::testing::FakePort port(bus);
      ASSERT_TRUE(port.list());
      const auto handle = port.open("/dev/hidraw0");
      ASSERT_TRUE(handle);
      ImpulseEngineOptions options;
      if (rate > 0.0) options.axes[0] = AxisDescription{1e-4, limit_n, {}, rate};
      const auto described = hid::describe(hid::testing::usual_listing(), **handle, options);
      ASSERT_TRUE(described);
      const double usual = limit_n > 10.0 ? limit_n / 2e-3 : 0.0;
      EXPECT_DOUBLE_EQ(described->axis[0].max_force_rate_n_per_s, rate > 0.0 ? rate : usual);
    }
  }
}

TEST(LinkOpening, ADeviceThatDescribedItselfHasToGoOnDoingSo) {
  ImpulseEngineOptions options;
  options.axes[0] = AxisDescription{0.25e-3, 20.0};  // more than the device allows
  Rig rig({}, options);
  rig.drive_until_ms(100);
  rig.replug();
  rig.plug.feature_is_missing = true;
  rig.host.ticks(1200);
  EXPECT_EQ(rig.host.stats().trouble, Trouble::kRefused);
  EXPECT_EQ(rig.host.owner.words(),
            "/dev/hidraw0 no longer sends its INFO report: plug the device in again");
  rig.plug.feature_is_missing = false;
  EXPECT_TRUE(rig.host.come_up());
}

TEST(LinkOpening, AListingThatComesTwiceIsOneDevice) {
  Rig rig;
  rig.plug.listed_times = 3;
  rig.drive_until_ms(100);
  EXPECT_EQ(rig.bus.open_handles(), 2U);
}

TEST(LinkOpening, OpensTheOneOfTwoDevicesThatIsMeant) {
  hid::testing::FakeBus bus;
  auto& first = bus.add(usual_listing("/dev/hidraw0", "A"), hid::testing::one_axis());
  auto& second = bus.add(usual_listing("/dev/hidraw1", "B"), hid::testing::one_axis());
  ImpulseEngineOptions options;
  options.serial = "B";
  VirtualHost host(bus, options);
  host.behaviour.force_n = {1.0, 0.0};
  ASSERT_TRUE(host.come_up());
  EXPECT_TRUE(first.handles.empty());
  EXPECT_EQ(second.handles.size(), 2U);
  // It is gone: the other device is not chosen instead.
  second.hidden = true;
  host.ticks(2500);
  EXPECT_TRUE(first.handles.empty());
  // It comes back at another place.
  second.hidden = false;
  second.listing.path = "/dev/hidraw7";
  EXPECT_TRUE(host.come_up());
  EXPECT_EQ(second.handles.size(), 2U);
}

TEST(LinkOpening, WithoutASerialNumberTheDeviceComesBackWhereItIsPluggedIn) {
  Rig rig;
  rig.plug.listing.serial = "";
  rig.drive_until_ms(100);
  rig.replug();
  rig.plug.listing.path = "/dev/hidraw3";
  EXPECT_TRUE(rig.host.come_up());
  EXPECT_EQ(rig.host.stats().losses, 1U);
}

TEST(LinkOpening, ATransportThatDoesNotWorkIsTold) {
  LinkExchange exchange;
  const HostClock clock = [] { return std::int64_t{0}; };
  LinkReader reader(exchange, clock);
  LinkOwner owner(
      exchange, reader, {},
      []() -> Result<std::shared_ptr<hid::Port>> {
        return Error{ErrorKind::kDevice, "no transport"};
      },
      clock, [](const std::shared_ptr<WriteSession>&) { return [] {}; });
  owner.step();
  EXPECT_EQ(owner.words(), "no transport");
  EXPECT_EQ(exchange.status.load().reason, Trouble::kRefused);
  owner.stop();
  owner.step();
  EXPECT_EQ(owner.ending(), Ending::kEnded);
}

}  // namespace
}  // namespace hapticwall::device
