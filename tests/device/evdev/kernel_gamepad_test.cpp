// The port to gamepads through a kernel and a real driver. tests/hid_guest runs it in a guest;
// elsewhere it needs /dev/uhid and the module hid-microsoft.
#include "tests/device/evdev/kernel_gamepad.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "device/evdev/event_node.h"
#include "device/evdev/gamepad.h"

namespace hapticwall::device::evdev::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;
using Percent = KernelGamepad::Percent;

bool is_there() {
  for (const NodeListing& listing : list_nodes())
    if (listing.name() == KernelGamepad::kName && listing.has("key", BTN_GAMEPAD))
      return listing.has("ff", FF_RUMBLE) && EventNode::open(listing.path()).ok();
  return false;
}

bool within_seconds(const std::function<bool()>& condition) {
  for (int i = 0; i < 300; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

class KernelGamepadTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const bool demanded =
        std::getenv("HAPTICWALL_GUEST") != nullptr;  // NOLINT(concurrency-mt-unsafe)
    const bool there = kernels_.there() && within_seconds(is_there);
    if (!there && !demanded) GTEST_SKIP() << "no /dev/uhid, no hid-microsoft, or no right to it";
    ASSERT_TRUE(there);
    Result<std::unique_ptr<Gamepad>> opened = open_first_gamepad();
    ASSERT_TRUE(opened) << opened.error().message;
    gamepad_ = std::move(*opened);
    if (gamepad_->name().find(KernelGamepad::kName) == std::string::npos)
      GTEST_SKIP() << "this machine has a gamepad of its own: " << gamepad_->name();
  }
  KernelGamepad kernels_;
  std::unique_ptr<Gamepad> gamepad_;
};

TEST_F(KernelGamepadTest, RumblesAndStopsByItself) {
  EXPECT_THAT(gamepad_->name(), HasSubstr("/dev/input/event"));
  EXPECT_FALSE(gamepad_->rumble({65535, 32768}));
  EXPECT_THAT(kernels_.next(), Optional(Percent{100, 50}));
  EXPECT_THAT(kernels_.next(), Optional(Percent{0, 0})) << "nobody renews it";
}

TEST_F(KernelGamepadTest, LevelsFollowEachOtherAndAreStoppedAtOnce) {
  for (const int strong : {20000, 40000, 60000}) {
    EXPECT_FALSE(gamepad_->rumble({static_cast<std::uint16_t>(strong), 0}));
    EXPECT_THAT(kernels_.next(), Optional(Percent{strong * 100 / 65535, 0}));
  }
  EXPECT_FALSE(gamepad_->rumble({}));
  EXPECT_THAT(kernels_.next(), Optional(Percent{0, 0}));
}

// A program that ends or is killed closes its node.
TEST_F(KernelGamepadTest, ClosingStopsIt) {
  EXPECT_FALSE(gamepad_->rumble({65535, 65535}));
  EXPECT_THAT(kernels_.next(), Optional(Percent{100, 100}));
  gamepad_.reset();
  EXPECT_THAT(kernels_.next(), Optional(Percent{0, 0}));
}

TEST_F(KernelGamepadTest, AnUnpluggedOneIsAnError) {
  EXPECT_FALSE(gamepad_->rumble({65535, 0}));
  kernels_.unplug();
  Failure failure;
  EXPECT_TRUE(within_seconds([&] { return (failure = gamepad_->rumble({1000, 0})).has_value(); }));
  EXPECT_THAT(failure->message, HasSubstr("No such device"));
  EXPECT_TRUE(within_seconds([] { return !is_there(); }));
}

}  // namespace
}  // namespace hapticwall::device::evdev::test
