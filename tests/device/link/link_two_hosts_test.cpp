// One host a device: a second one is refused and told so, and the first one goes on.
#include <gtest/gtest.h>

#include "tests/device/link/link_rig.h"

namespace hapticwall::device {
namespace {

using testing::Rig;
using testing::VirtualHost;

constexpr int kAllAttempts = 2000;  // ticks; enough for all attempts of an opening
constexpr const char* kInUse = "/dev/hidraw0 is in use by another host: end that session first";

// Two hosts with the same time; the second one asks for another force.
struct TwoHosts : Rig {
  TwoHosts() {
    second.behaviour.force_n = {-5.0, 0.0};
    host.after_tick = [this] { second.tick(); };
  }

  VirtualHost second{bus, {}};
};

TEST(LinkTwoHosts, TheSecondIsRefusedAndTheFirstGoesOn) {
  TwoHosts desk;
  desk.drive_until_ms(300);
  desk.second.arm();
  bool held = true;
  for (int i = 0; i < kAllAttempts; ++i) {
    desk.host.tick();
    held = held && desk.pushes();
  }
  EXPECT_TRUE(held);
  EXPECT_TRUE(desk.host.troubles.empty());
  EXPECT_EQ(desk.host.stats().rejected_commands, 0U);
  EXPECT_EQ(desk.second.owner.opening(), Opening::kFailed);
  EXPECT_EQ(desk.second.owner.words(), kInUse);
  EXPECT_EQ(desk.second.stats().trouble, Trouble::kRefused);
  EXPECT_EQ(desk.bus.open_handles(), 2U);
}

TEST(LinkTwoHosts, TheSecondComesUpOnceTheFirstHasEndedAndWithoutForce) {
  TwoHosts desk;
  desk.drive_until_ms(300);
  desk.host.owner.stop();
  ASSERT_TRUE(desk.host.ticks_until([&] { return desk.second.last.state == DeviceState::kOk; },
                                    kAllAttempts));
  EXPECT_EQ(desk.second.owner.words(), "");
  desk.host.ticks(100);
  EXPECT_EQ(desk.force_n(), 0.0);
  desk.second.rearm();
  desk.host.ticks(5);
  EXPECT_EQ(desk.force_n(), 5.0);
}

// The lock goes with the loss, and has to be taken again.
TEST(LinkTwoHosts, AReplugThatTheOtherOneWinsIsToldAndTheSearchGoesOn) {
  TwoHosts desk;
  desk.drive_until_ms(300);
  desk.plug.hidden = true;
  desk.host.ticks(5);
  desk.host.stalled = true;
  desk.plug.hidden = false;
  ASSERT_TRUE(desk.host.ticks_until([&] { return desk.second.last.state == DeviceState::kOk; },
                                    kAllAttempts));
  desk.host.stalled = false;
  desk.host.ticks(kAllAttempts);
  EXPECT_EQ(desk.host.owner.words(), kInUse);
  EXPECT_EQ(desk.host.stats().trouble, Trouble::kRefused);
  desk.second.owner.stop();
  EXPECT_TRUE(desk.host.come_up());
  EXPECT_EQ(desk.host.owner.words(), "");
  desk.host.ticks(100);
  EXPECT_EQ(desk.force_n(), 0.0);
}

}  // namespace
}  // namespace hapticwall::device
