// Tests how the real libhidapi reads /sys, through the program's port.
#include <array>
#include <clocale>
#include <string>
#include <vector>

#include "tests/umockdev/hidraw_test.h"

namespace hapticwall::device::hid::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class HidrawListing : public HidrawTest {};

// Desktop, keyboard.
const std::vector<std::uint8_t> kKeyboard{0x05, 0x01, 0x09, 0x06, 0xA1, 0x01, 0xC0};

std::vector<std::uint8_t> joined(std::vector<std::uint8_t> first,
                                 const std::vector<std::uint8_t>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<std::uint8_t> protocols_descriptor() { return MockIdentity{}.descriptor; }

TEST_F(HidrawListing, TellsAllOfADevice) {
  const MockDevice& device = bus_.plug();
  const Listing expected{device.path(), kTestVendorId, kTestProductId, "A-1",
                         "Workshop",    "Paddle",      kUsagePage,     kUsage};
  EXPECT_THAT(listed(), ElementsAre(expected));
  EXPECT_TRUE(may_be_haptic(expected));
}

TEST_F(HidrawListing, ADeviceThatIsNotOnUsbIsKnownByItsName) {
  MockIdentity identity;
  identity.is_on_usb = false;
  const Listing listing = listing_of(bus_.plug(identity).path());
  EXPECT_EQ(listing.product, "Workshop Paddle");
  EXPECT_EQ(listing.serial, "A-1");
  EXPECT_TRUE(may_be_haptic(listing));
}

TEST_F(HidrawListing, AForeignDeviceIsListedAndIsNotHaptic) {
  MockIdentity identity;
  identity.vendor_id = 0x046D;
  identity.descriptor = kKeyboard;
  const MockDevice& foreign = bus_.plug(identity);
  const MockDevice& ours = bus_.plug();
  EXPECT_FALSE(may_be_haptic(listing_of(foreign.path())));
  EXPECT_TRUE(may_be_haptic(listing_of(ours.path())));
}

TEST_F(HidrawListing, TwoOfAKindDifferInPathAndSerialNumber) {
  MockIdentity identity;
  const MockDevice& first = bus_.plug(identity);
  identity.serial = "A-2";
  const MockDevice& second = bus_.plug(identity);
  EXPECT_EQ(listing_of(first.path()).serial, "A-1");
  EXPECT_EQ(listing_of(second.path()).serial, "A-2");
}

TEST_F(HidrawListing, AnEmptyMachineHasAnEmptyList) { EXPECT_THAT(listed(), IsEmpty()); }

TEST_F(HidrawListing, DevicesComeAndGo) {
  MockDevice& first = bus_.plug();
  EXPECT_EQ(listed().size(), 1U);
  const MockDevice& second = bus_.plug();
  EXPECT_EQ(listed().size(), 2U);
  bus_.unplug(first);
  const std::vector<Listing> rest = listed();
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest.front().path, second.path());
  EXPECT_EQ(port_->obstacle(first.path()), Obstacle::kGone);
}

// libhidapi lists a path once for each of its collections.
TEST_F(HidrawListing, APathWithSeveralUsagesIsListedOnceWithTheProtocols) {
  MockIdentity identity;
  identity.descriptor = joined(kKeyboard, protocols_descriptor());
  const MockDevice& keyboard_first = bus_.plug(identity);
  identity.descriptor = joined(protocols_descriptor(), kKeyboard);
  const MockDevice& keyboard_last = bus_.plug(identity);
  EXPECT_EQ(listing_of(keyboard_first.path()).usage_page, kUsagePage);
  EXPECT_EQ(listing_of(keyboard_last.path()).usage_page, kUsagePage);
}

TEST_F(HidrawListing, WithoutADescriptorTheUsageIsNotKnown) {
  MockIdentity identity;
  identity.has_descriptor_file = false;
  const Listing listing = listing_of(bus_.plug(identity).path());
  EXPECT_EQ(listing.usage_page, 0);
  EXPECT_EQ(listing.vendor_id, kTestVendorId);
}

TEST_F(HidrawListing, WhatTheKernelDoesNotTellHidesNoOtherDevice) {
  for (const char* left_out : {"HID_ID", "HID_NAME", "HID_UNIQ"}) {
    MockIdentity identity;
    identity.left_out = left_out;
    bus_.plug(identity);
  }
  for (const char* hid_id :
       {"no number", "0003", "0003:00001209", "0099:00001209:00000001", ":::"}) {
    MockIdentity identity;
    identity.hid_id = hid_id;
    bus_.plug(identity);
  }
  const MockDevice& whole = bus_.plug();
  EXPECT_EQ(listing_of(whole.path()).vendor_id, kTestVendorId);
}

TEST_F(HidrawListing, ADescriptorThatEndsTooEarlyIsNoHarm) {
  const std::vector<std::uint8_t> whole = protocols_descriptor();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    MockIdentity identity;
    identity.descriptor.assign(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    bus_.plug(identity);
  }
  for (const std::uint8_t item :
       std::to_array<std::uint8_t>({0x07, 0x0B, 0xA3, 0xFE, 0xFF})) {  // the head of a long one
    MockIdentity identity;
    identity.descriptor.assign(1, item);
    bus_.plug(identity);
    identity.descriptor.assign(4096, item);  // the most that the kernel takes
    bus_.plug(identity);
  }
  const MockDevice& good = bus_.plug();
  EXPECT_EQ(listing_of(good.path()).usage_page, kUsagePage);
}

// libhidapi reads them by the locale of the process.
TEST_F(HidrawListing, AStringIsUtf8AndOneThatIsNotIsEmpty) {
  const std::string before = std::setlocale(LC_CTYPE, nullptr);
  ASSERT_NE(std::setlocale(LC_CTYPE, "C.UTF-8"), nullptr);
  MockIdentity identity;
  identity.manufacturer = "W\xC3\xB6rkshop";
  identity.product = "Paddle\xFF";
  identity.serial = std::string(126, '7');
  const Listing listing = listing_of(bus_.plug(identity).path());
  EXPECT_EQ(listing.manufacturer, identity.manufacturer);
  EXPECT_EQ(listing.product, "");
  EXPECT_EQ(listing.serial, identity.serial);
  EXPECT_NE(std::setlocale(LC_CTYPE, before.c_str()), nullptr);
}

}  // namespace
}  // namespace hapticwall::device::hid::testing
