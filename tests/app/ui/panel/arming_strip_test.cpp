// A real device in the window: the force is obvious, and Space removes it.
#include "app/ui/panel/arming_strip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using session::ArmingNote;
using session::ArmingState;
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

TEST_F(ArmingStripTest, ALetterInATextArmsNothing) {
  click("recording name");
  press(ImGuiKey_A);
  EXPECT_THAT(fake_->arm_requests, IsEmpty());
}

TEST_F(ArmingStripTest, StatesTheForceAndTheReason) {
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
  fake_->arming.limit_share = 0.1;
  EXPECT_EQ(text(), "FORCE WEAK: " + std::string(session::kWeakText));
}

// Off and on differ in colour over the whole width.
TEST_F(ArmingStripTest, IsPaintedDifferentlyWhenTheForceIsOn) {
  const auto red_at_the_far_end = [&] {
    return pixel(screen(), kScreenWidth - 40, static_cast<int>(rect("FORCE…").centre().y)).red;
  };
  frames(2);
  const int off = red_at_the_far_end();
  fake_->arming = {ArmingState::kOn, ArmingNote::kNone, 1.0, 1};
  frames(2);
  EXPECT_GT(red_at_the_far_end(), off + 60);
}

// A new rate needs a new session; with one device the old session ends first.
TEST_F(ArmingStripTest, ANewSessionTakesTheDeviceFromTheOldOne) {
  scroll_down_at("stiffness");
  type("rate", "2000");
  EXPECT_EQ(sessions, 2);
  EXPECT_EQ(devices_open, 1);
  EXPECT_EQ(scene().sampling.rate_hz, 2000.0);
  EXPECT_EQ(fake_->info.name, "paddle");
}

TEST_F(ArmingStripTest, TheSimulatorContinuesWithoutTheDevice) {
  refuse_device = "no haptic device is connected";
  scroll_down_at("stiffness");
  type("rate", "2000");
  EXPECT_TRUE(fake_->info.is_simulated);
  EXPECT_THAT(message().text, HasSubstr("no haptic device is connected"));
  EXPECT_THAT(message().text, HasSubstr("this is the simulator now"));
  frames(3);
  EXPECT_FALSE(sees("arm")) << "nothing to arm";
}

TEST_F(GuiTest, ASimulatorHasNoStrip) {
  EXPECT_FALSE(sees("arm"));
  press(ImGuiKey_Space);
  EXPECT_FALSE(sees("age"));
}

}  // namespace
}  // namespace hapticwall::test
