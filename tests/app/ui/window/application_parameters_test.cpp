// Changes of device, hand and integrator from the window during a session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ui::MessageKind;

class ParametersTest : public GuiTest {
 protected:
  // Opens a section and scrolls to its end.
  void open_section(const std::string& title) {
    click("section " + title);
    scroll_down_at("section " + title);
  }
  [[nodiscard]] const DeviceSettings& device() const { return scene().x().device; }
  [[nodiscard]] const HandSettings& hand() const { return *scene().x().hand; }
};

TEST_F(ParametersTest, TypedValuesAreInForceWithoutANewSession) {
  live(700);
  open_section("Device");
  type("device.mass_kg", "0.2");
  type("device.encoder_m", "0.1");
  EXPECT_DOUBLE_EQ(device().mass_kg, 0.2);
  EXPECT_DOUBLE_EQ(device().encoder_m.value(), 1e-4);
  live(300);
  EXPECT_EQ(sessions, 1);
  EXPECT_EQ(newest().tick, 999U) << "the session continued";
  EXPECT_FALSE(refusal().has_value());
}

TEST_F(ParametersTest, ASwitchedOffPartComesBackWithItsValue) {
  open_section("Device");
  type("device.friction_n", "0.3");
  click("switch device.friction_n");
  EXPECT_FALSE(device().friction_n.has_value());
  click("device.friction_n");  // there is nothing to type into
  EXPECT_FALSE(device().friction_n.has_value());
  click("switch device.friction_n");
  EXPECT_DOUBLE_EQ(device().friction_n.value(), 0.3);
}

TEST_F(ParametersTest, APartNewToTheSceneStartsWithAUsualValue) {
  open_section("Device");
  click("switch device.delay_ticks");
  EXPECT_EQ(device().delay_ticks.value(), 1);
  click("switch device.amplifier_time_constant_s");
  EXPECT_DOUBLE_EQ(device().amplifier_time_constant_s.value(), 1e-3);
  click("switch device.force_resolution_n");
  EXPECT_DOUBLE_EQ(device().force_resolution_n.value(), 0.01);
  type("device.delay_ticks", "7");
  EXPECT_EQ(device().delay_ticks.value(), 7);
}

TEST_F(ParametersTest, ARefusalStandsBelowItsField) {
  open_section("Device");
  type("device.mass_kg", "-5");
  ASSERT_TRUE(refusal().has_value());
  EXPECT_EQ(refusal()->key, "device.mass_kg");
  EXPECT_THAT(refusal()->why, HasSubstr("-5 is out of range"));
  EXPECT_DOUBLE_EQ(device().mass_kg, 0.05);
  frames(2);
  EXPECT_GE(rect(refusal()->why).from.y, rect("device.mass_kg").to.y);
  EXPECT_LE(rect(refusal()->why).to.y, rect("device.damping_n_s_per_m").from.y);
  EXPECT_EQ(message().kind, MessageKind::kNone);
  type("device.mass_kg", "heavy");
  EXPECT_THAT(refusal()->why, HasSubstr("'heavy' is not a number"));
  type("device.mass_kg", "0.1");
  EXPECT_FALSE(refusal().has_value());
  click("switch device.delay_ticks");
  type("device.delay_ticks", "1.5");
  EXPECT_THAT(refusal()->why, HasSubstr("no whole number"));
  EXPECT_EQ(device().delay_ticks.value(), 1);
}

TEST_F(ParametersTest, AContradictionIsSaidInWords) {
  open_section("Hand");
  click("switch hand.mass_kg");
  EXPECT_DOUBLE_EQ(hand().mass_kg.value(), 0.4);
  ASSERT_TRUE(refusal().has_value());
  EXPECT_EQ(refusal()->key, "hand.mass_kg");
  EXPECT_THAT(refusal()->why, HasSubstr("a grip holds the handle with a hand's mass"));
}

TEST_F(ParametersTest, AGripTakesItsDampingWithIt) {
  open_section("Hand");
  click("switch hand.grip_stiffness_n_per_m");
  EXPECT_FALSE(hand().has_grip());
  EXPECT_FALSE(hand().grip_damping_n_s_per_m.has_value());
  click("switch hand.mass_kg");
  EXPECT_FALSE(hand().mass_kg.has_value());
  click("switch hand.grip_damping_n_s_per_m");
  EXPECT_THAT(refusal()->why, HasSubstr("a grip needs its spring"));
  click("switch hand.mass_kg");
  click("switch hand.grip_stiffness_n_per_m");
  EXPECT_DOUBLE_EQ(hand().grip_stiffness_n_per_m.value(), 1000.0);
  EXPECT_EQ(sessions, 1);
}

TEST_F(ParametersTest, EverythingGoesBackToTheSceneAtOnce) {
  EXPECT_FALSE(sees("reset to scene"));
  type("stiffness", "20000");
  type("algorithm.rest_force_step_n", "0.02");
  click("integrator");
  click("rk4");
  open_section("Device");
  type("device.mass_kg", "0.2");
  click("switch device.friction_n");
  scroll_down_at("rate");
  type("rate", "2000");  // a new session, with all that was changed
  EXPECT_EQ(sessions, 2);
  EXPECT_DOUBLE_EQ(device().mass_kg, 0.2);
  press(ImGuiKey_2);
  wheel_at(rect("rate").centre(), 100.0F);
  click("reset to scene");
  const Scene loaded = file::load_scene("press")->scene;
  EXPECT_EQ(device(), loaded.x().device);
  EXPECT_EQ(scene().simulator, loaded.simulator);
  EXPECT_EQ(wall().stiffness_n_per_m, 35000.0);
  EXPECT_EQ(scene().algorithm.values, loaded.algorithm.values);
  EXPECT_EQ(scene().algorithm.index, 1U) << "the choice stays";
  EXPECT_DOUBLE_EQ(scene().sampling.rate_hz, 2000.0);
  EXPECT_EQ(sessions, 2);
  EXPECT_FALSE(sees("reset to scene"));
}

TEST_F(ParametersTest, AFollowingAlgorithmBringsItsOwnParameters) {
  press(ImGuiKey_4);
  EXPECT_FALSE(sees("algorithm.observer"));
  click("algorithm.then");
  click("then = passivity-control");
  EXPECT_EQ(algorithm_label(scene().algorithm), "energy-bounding then passivity-control");
  for (const char* key : {"algorithm.rest_force_step_n", "algorithm.damping_n_s_per_m",
                          "algorithm.observer", "algorithm.max_damping_n_s_per_m"}) {
    EXPECT_TRUE(sees(key)) << key;
  }
  type("algorithm.max_damping_n_s_per_m", "3");
  click("algorithm.then");
  click("then = none");
  EXPECT_FALSE(has_follower(scene().algorithm));
  EXPECT_FALSE(sees("algorithm.observer"));
}

TEST_F(ParametersTest, ASceneWithoutAHandSaysSo) {
  Scene free = file::load_scene("press")->scene;
  free.x().hand.reset();
  state().scene.wanted = ui::WantedScene{free, true};
  frames(3);
  click("section Hand");
  EXPECT_FALSE(sees("hand.mass_kg"));
  EXPECT_FALSE(sees("reset to scene"));
}

}  // namespace
}  // namespace hapticwall::test
