// Devices that are listed and cannot be opened: what stands in the way is named.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/umockdev/hidraw_test.h"
#include "tests/umockdev/nobodys_rights.h"

namespace hapticwall::device::hid::testing {
namespace {

using hapticwall::test::NobodysRights;
using ::testing::HasSubstr;

class HidrawOpening : public HidrawTest {};

TEST_F(HidrawOpening, ADeviceThatIsThereOpens) {
  const MockDevice& device = bus_.plug();
  static_cast<void>(listed());
  EXPECT_EQ(port_->obstacle(device.path()), Obstacle::kNone);
  EXPECT_NE(opened(device), nullptr);
}

TEST_F(HidrawOpening, OneThatMayNotBeOpenedOrOnlyBeReadNamesTheRule) {
  for (const mode_t mode : {0U, 0444U}) {
    SCOPED_TRACE(mode);
    const MockDevice& device = bus_.plug();
    ASSERT_EQ(::chmod(device.node_file().c_str(), mode), 0);
    const NobodysRights guard;
    EXPECT_EQ(listing_of(device.path()).vendor_id, kTestVendorId);
    EXPECT_EQ(port_->obstacle(device.path()), Obstacle::kPermission);
    EXPECT_EQ(refusal_of(device.path()), obstacle_text(device.path(), Obstacle::kPermission));
  }
}

TEST_F(HidrawOpening, OneThatWentAfterItWasListedIsGone) {
  MockDevice& device = bus_.plug();
  EXPECT_EQ(listed().size(), 1U);
  bus_.unplug(device);
  EXPECT_EQ(port_->obstacle(device.path()), Obstacle::kGone);
  EXPECT_EQ(refusal_of(device.path()), obstacle_text(device.path(), Obstacle::kGone));
}

TEST_F(HidrawOpening, OneThatAnotherHostHasIsRefusedUntilItIsFree) {
  const MockDevice& device = bus_.plug();
  EXPECT_EQ(listed().size(), 1U);
  const int other = ::open(device.node_file().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  EXPECT_THAT(refusal_of(device.path()),
              HasSubstr(device.path() + " is in use by umockdev_tests (process " +
                        std::to_string(::getpid()) + ")"));
  EXPECT_EQ(port_->obstacle(device.path()), Obstacle::kNone);
  ::flock(other, LOCK_UN);
  {
    auto reader = opened(device);
    auto writer = opened(device);
    EXPECT_NE(::flock(other, LOCK_EX | LOCK_NB), 0);
    reader.reset();
    EXPECT_NE(::flock(other, LOCK_EX | LOCK_NB), 0) << "the writer's handle still has it";
  }
  EXPECT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  ::close(other);
}

TEST_F(HidrawOpening, WhatWasNeverListedIsNotOpened) {
  EXPECT_THAT(listed(), ::testing::IsEmpty());
  for (const char* path : {"/dev/hidraw7", "/dev/null", "/etc/hostname", "", "hidraw0"}) {
    SCOPED_TRACE(path);
    EXPECT_NE(refusal_of(path), "");
  }
}

TEST_F(HidrawOpening, ANodeThatIsNoHidrawIsRefused) {
  MockDevice& device = bus_.plug();
  EXPECT_EQ(listed().size(), 1U);
  bus_.make_deaf(device);
  EXPECT_THAT(refusal_of(device.path()), HasSubstr("it does not answer as a HID device"));
}

TEST_F(HidrawOpening, AfterARefusalAnotherDeviceOpens) {
  MockDevice& gone = bus_.plug();
  const MockDevice& good = bus_.plug();
  EXPECT_EQ(listed().size(), 2U);
  bus_.unplug(gone);
  EXPECT_NE(refusal_of(gone.path()), "");
  EXPECT_NE(opened(good), nullptr);
}

TEST_F(HidrawOpening, ADeviceOpensTwiceAndAgainAfterItWasClosed) {
  const MockDevice& device = bus_.plug();
  EXPECT_EQ(listed().size(), 1U);
  {
    const auto first = opened(device);
    const auto second = opened(device);
    EXPECT_NE(first, nullptr);
    EXPECT_NE(second, nullptr);
  }
  EXPECT_NE(opened(device), nullptr);
}

}  // namespace
}  // namespace hapticwall::device::hid::testing
