// The code around hidapi, and hidapi itself without a device.
#include "device/link/port.h"

#include <gtest/gtest.h>

#include <string>

#include "core/text.h"
#include "device/port/impulse_engine.h"

namespace hapticwall::device::hid {
namespace {

Listing listing(const std::string& path, std::uint16_t usage_page, std::uint16_t usage) {
  Listing listing;
  listing.path = path;
  listing.usage_page = usage_page;
  listing.usage = usage;
  return listing;
}

TEST(HidPort, MayBeHapticByItsUsageOrWhereNoneIsTold) {
  EXPECT_TRUE(may_be_haptic(listing("a", kUsagePage, kUsage)));
  EXPECT_TRUE(may_be_haptic(listing("a", 0, 0)));
  EXPECT_FALSE(may_be_haptic(listing("a", 0x0001, 0x0006)));  // a keyboard
  EXPECT_FALSE(may_be_haptic(listing("a", kUsagePage, 2)));
}

TEST(HidPort, EachPathIsOneDeviceAndTheUsageOfTheProtocolWins) {
  const std::vector<Listing> once = each_path_once(
      {listing("a", 0x0001, 0x0006), listing("b", kUsagePage, kUsage), listing("a", 0x000C, 1),
       listing("a", kUsagePage, kUsage), listing("b", 0x0001, 2), listing("a", 0x0001, 2)});
  ASSERT_EQ(once.size(), 2U);
  EXPECT_EQ(once[0], listing("a", kUsagePage, kUsage));
  EXPECT_EQ(once[1], listing("b", kUsagePage, kUsage));
}

TEST(HidPort, EveryObstacleHasItsSentence) {
  EXPECT_EQ(obstacle_text("p", Obstacle::kNone), "");
  EXPECT_EQ(obstacle_text("p", Obstacle::kBusy), "p is in use: close the program that uses it");
  EXPECT_EQ(obstacle_text("p", Obstacle::kGone),
            "p is no longer connected: plug the device in again");
  EXPECT_NE(obstacle_text("p", Obstacle::kPermission).find("70-hapticwall.rules"),
            std::string::npos);
}

TEST(HidPort, WideTextBecomesUtf8) {
  EXPECT_EQ(to_utf8(nullptr), "");
  EXPECT_EQ(to_utf8(L""), "");
  EXPECT_EQ(to_utf8(L"Impulse"), "Impulse");
  EXPECT_EQ(to_utf8(L"\u00e9\u0394\u20ac\U0001F600"), "\u00e9\u0394\u20ac\U0001F600");
  EXPECT_EQ(to_utf8(L"\u00a0\u07ff\u0800\uffff\U00010000\U0010ffff"),
            "\u00a0\u07ff\u0800\uffff\U00010000\U0010ffff");
  // A terminal's commands.
  EXPECT_EQ(to_utf8(L"a\x1b[2J\x7f\u009b"), "a\uFFFD[2J\uFFFD\uFFFD");
  const wchar_t bad[] = {L'a',
                         static_cast<wchar_t>(0xD800),
                         static_cast<wchar_t>(0x110000),
                         static_cast<wchar_t>(-1),
                         L'b',
                         0};
  EXPECT_EQ(to_utf8(bad), "a\uFFFD\uFFFD\uFFFDb");
}

// hidapi itself.
TEST(SystemPort, ListsAndOpensNothingThatWasNotListed) {
  auto port = open_system_port();
  ASSERT_TRUE(port) << port.error().message;
  const auto listings = (*port)->list();
  ASSERT_TRUE(listings) << listings.error().message;
  EXPECT_EQ(each_path_once(*listings), *listings);
  const auto handle = (*port)->open("/dev/null");
  ASSERT_FALSE(handle);
  EXPECT_EQ(handle.error().message, "/dev/null is not in the list of HID devices");
  EXPECT_EQ((*port)->obstacle("/dev/there-is-no-such-device"), Obstacle::kGone);
  EXPECT_FALSE(transport_name().empty());
}

TEST(SystemPort, ThereIsOneAtATime) {
  auto first = open_system_port();
  ASSERT_TRUE(first);
  EXPECT_FALSE(open_system_port());
  *first = nullptr;
  EXPECT_TRUE(open_system_port());
}

TEST(SystemPort, ADeviceThatIsNotThereIsNotOpened) {
  ImpulseEngineOptions options;
  options.serial = "of no device in the world";
  const auto engine = make_impulse_engine(options);
  for (int round = 0; round < 2; ++round) {
    const Failure failure = engine->open();
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->message,
              "no haptic device with the serial number of no device in the world is connected; "
              "'hapticwall devices' lists the connected devices");
  }
}

}  // namespace
}  // namespace hapticwall::device::hid
