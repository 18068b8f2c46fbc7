// A real device in the window: the force is obvious, and Space removes it.
#include "app/ui/panel/arming_strip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using runtime::ArmingNote;
using runtime::ArmingState;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ArmingStripTest : public GuiTest {
 protected:
  void SetUp() override {
    with_device = true;
    GuiTest::SetUp();
  }
  [[nodiscard]] std::string text() const { return ui::arming_text(fake_->snapshot()); }
};

TEST_F(ArmingStripTest, ButtonAndKeyAskToArm) {
  click("arm");
  press(ImGuiKey_A);
  EXPECT_THAT(fake_->arm_requests, ElementsAre(true, true));
}

TEST_F(ArmingStripTest, ButtonAndSpaceTakeTheForceAway) {
  fake_->arming = {ArmingState::kOn, ArmingNote::kNone, 1.0, 1};
  frames(2);
  click("arm");
  press(ImGuiKey_Space);
  EXPECT_THAT(fake_->arm_requests, ElementsAre(false, false));
}

TEST_F(ArmingStripTest, SpaceDoesSoWhileATextIsTyped) {
  fake_->arming = {ArmingState::kOn, ArmingNote::kNone, 1.0, 1};
  click("recording name");
  press(ImGuiKey_A);  // a letter here
  EXPECT_THAT(fake_->arm_requests, IsEmpty());
  press(ImGuiKey_Space);
  EXPECT_THAT(fake_->arm_requests, ElementsAre(false));
}

TEST_F(ArmingStripTest, SaysWhatIs) {
  EXPECT_EQ(text(), "FORCE OFF");
  fake_->arming = {ArmingState::kOff, ArmingNote::kInsideWall, 0.0, 1};
  EXPECT_EQ(text(), "FORCE OFF: the handle is inside the wall: move it out first");
  fake_->link.trouble = device::Trouble::kEmergencyStop;
  EXPECT_EQ(text(),
            "FORCE OFF: " + std::string(device::trouble_text(device::Trouble::kEmergencyStop)));
  fake_->link.trouble = device::Trouble::kNone;
  fake_->arming = {ArmingState::kRamping, ArmingNote::kNone, 0.42, 1};
  EXPECT_EQ(text(), "FORCE RISING  42 %");
  fake_->arming = {ArmingState::kOn, ArmingNote::kNone, 1.0, 1};
  EXPECT_EQ(text(), "FORCE ON");
}

// Off and on differ in colour over the whole width.
TEST_F(ArmingStripTest, IsPaintedDifferentlyWhenTheForceIsOn) {
  const auto red_at_the_far_end = [&] {
    const file::Picture picture = screen();
    const ItemRect strip = rect("FORCE…");
    const auto x = static_cast<std::size_t>(kScreenWidth - 40);
    const auto y = static_cast<std::size_t>(strip.centre().y);
    return static_cast<int>(picture.rgba[4 * (y * static_cast<std::size_t>(picture.width) + x)]);
  };
  frames(2);
  const int off = red_at_the_far_end();
  fake_->arming = {ArmingState::kOn, ArmingNote::kNone, 1.0, 1};
  frames(2);
  EXPECT_GT(red_at_the_far_end(), off + 60);
}

TEST_F(ArmingStripTest, TheLinksFiguresStandInTheDevicePanel) {
  fake_->link.age_s = 1.2e-3;
  fake_->link.states = 1000;
  frames(2);
  EXPECT_TRUE(find("age").has_value());
  EXPECT_TRUE(find("reports").has_value());
  EXPECT_TRUE(find("delay").has_value());
  EXPECT_FALSE(find("device.delay_ticks").has_value()) << "the device's own cannot be set";
}

// A new rate needs a new session; with one device the old session ends first.
TEST_F(ArmingStripTest, ANewSessionTakesTheDeviceFromTheOldOne) {
  scroll_down_at("stiffness");
  type("rate", "2000");
  EXPECT_EQ(sessions, 2);
  EXPECT_EQ(devices_open, 1);
  EXPECT_EQ(fake_->scene().sampling.rate_hz, 2000.0);
  EXPECT_EQ(fake_->info.name, "paddle");
}

TEST_F(ArmingStripTest, WhereTheDeviceIsGoneTheSimulatorGoesOn) {
  refuse_device = "no haptic device is connected";
  scroll_down_at("stiffness");
  type("rate", "2000");
  EXPECT_TRUE(fake_->info.is_simulated);
  EXPECT_THAT(message().text, HasSubstr("no haptic device is connected"));
  EXPECT_THAT(message().text, HasSubstr("this is the simulator now"));
  frames(3);
  EXPECT_FALSE(find("arm").has_value()) << "nothing to arm";
}

TEST_F(GuiTest, ASimulatorHasNoStrip) {
  EXPECT_FALSE(find("arm").has_value());
  press(ImGuiKey_Space);
  EXPECT_FALSE(find("age").has_value());
}

}  // namespace
}  // namespace hapticwall::test
