// Changes of device, hand and integrator from the window during a session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/scene_keys.h"
#include "core/stabiliser/stabiliser.h"
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
    frames(2);
    scroll_down_at("section " + title);
  }
  [[nodiscard]] const DeviceSettings& device() const { return fake_->scene().x().device; }
  [[nodiscard]] const HandSettings& hand() const { return *fake_->scene().x().hand; }
};

TEST_F(ParametersTest, EveryKeyOfDeviceAndHandHasItsRow) {
  click("section Device");
  click("section Hand");
  frames(2);
  for (const auto& key : number_keys<DeviceSettings>()) {
    if (key.key == "start_m") continue;  // of a new session
    EXPECT_TRUE(find("device." + std::string(key.key)).has_value()) << key.key;
    const bool has_switch = find("switch device." + std::string(key.key)).has_value();
    EXPECT_EQ(has_switch, !std::holds_alternative<double DeviceSettings::*>(key.member)) << key.key;
  }
  for (const auto& key : number_keys<HandSettings>())
    EXPECT_TRUE(find("hand." + std::string(key.key)).has_value()) << key.key;
}

TEST_F(ParametersTest, TypedValuesAreInForceWithoutANewSession) {
  live(700);
  open_section("Device");
  type("device.mass_kg", "0.2");
  type("device.damping_n_s_per_m", "2.5");
  type("device.encoder_m", "1e-4");
  EXPECT_DOUBLE_EQ(device().mass_kg, 0.2);
  EXPECT_DOUBLE_EQ(device().damping_n_s_per_m, 2.5);
  EXPECT_DOUBLE_EQ(device().encoder_m.value(), 1e-4);
  live(300);
  EXPECT_EQ(sessions, 1);
  EXPECT_EQ(fake_->snapshot().newest.x().tick, 999U) << "it went on";
  EXPECT_FALSE(refusal().has_value());
}

TEST_F(ParametersTest, APartIsLeftOutAndComesBackAsItWas) {
  open_section("Device");
  type("device.friction_n", "0.3");
  click("switch device.friction_n");
  EXPECT_FALSE(device().friction_n.has_value());
  click("device.friction_n");  // there is nothing to type into
  EXPECT_FALSE(device().friction_n.has_value());
  click("switch device.friction_n");
  EXPECT_DOUBLE_EQ(device().friction_n.value(), 0.3);
}

TEST_F(ParametersTest, APartThatTheSceneNeverHadBeginsWithAUsualValue) {
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
  EXPECT_FALSE(find("reset to scene").has_value());
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
  move_to(rect("rate").centre());
  ImGui::GetIO().AddMouseWheelEvent(0.0F, 100.0F);
  frames(5);
  click("reset to scene");
  const Scene scene = file::load_scene("press")->scene;
  EXPECT_EQ(device(), scene.x().device);
  EXPECT_EQ(fake_->scene().simulator, scene.simulator);
  EXPECT_EQ(fake_->scene().x().walls[0].stiffness_n_per_m, 35000.0);
  EXPECT_EQ(fake_->scene().algorithm.values, scene.algorithm.values);
  EXPECT_EQ(fake_->scene().algorithm.index, 1U) << "the choice stays";
  EXPECT_DOUBLE_EQ(fake_->scene().sampling.rate_hz, 2000.0);
  EXPECT_EQ(sessions, 2);
  EXPECT_FALSE(find("reset to scene").has_value());
}

TEST_F(ParametersTest, WhatFollowsTheAlgorithmBringsItsOwnParameters) {
  press(ImGuiKey_4);
  EXPECT_FALSE(find("algorithm.observer").has_value());
  click("algorithm.then");
  click("then = passivity-control");
  frames(2);
  EXPECT_EQ(algorithm_label(fake_->scene().algorithm), "energy-bounding then passivity-control");
  for (const char* key : {"algorithm.rest_force_step_n", "algorithm.damping_n_s_per_m",
                          "algorithm.observer", "algorithm.max_damping_n_s_per_m"}) {
    EXPECT_TRUE(find(key).has_value()) << key;
  }
  type("algorithm.max_damping_n_s_per_m", "3");
  click("algorithm.then");
  click("then = none");
  frames(2);
  EXPECT_FALSE(has_follower(fake_->scene().algorithm));
  EXPECT_FALSE(find("algorithm.observer").has_value());
}

TEST_F(ParametersTest, AnotherSceneIsTheOneToGoBackTo) {
  type("stiffness", "20000");
  EXPECT_TRUE(find("reset to scene").has_value());
  click("Figure 5");
  frames(2);
  EXPECT_FALSE(find("reset to scene").has_value());
  EXPECT_EQ(fake_->scene().x().walls[0].stiffness_n_per_m, 35000.0);
}

TEST_F(ParametersTest, ASceneWithoutAHandSaysSo) {
  Scene free = file::load_scene("press")->scene;
  free.x().hand.reset();
  application_->state().transient.wanted_scene = ui::WantedScene{free, true};
  frames(3);
  click("section Hand");
  frames(2);
  EXPECT_FALSE(find("hand.mass_kg").has_value());
  EXPECT_FALSE(find("reset to scene").has_value());
}

}  // namespace
}  // namespace hapticwall::test
