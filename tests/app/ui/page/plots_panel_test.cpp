// The plots: every control, the keys, and the mouse.
#include "app/ui/page/plots_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using draw::PlotId;
using draw::Quantity;
using draw::TriggerMode;
using draw::TriggerStage;

class PlotsPanelTest : public GuiTest {
 protected:
  [[nodiscard]] ui::UiState& state() { return application_->state(); }
  [[nodiscard]] ui::PlotsState& plots() { return state().plots; }
  [[nodiscard]] draw::ValueAxis& left_axis(PlotId id) {
    return plots().transient.axes[static_cast<std::size_t>(id)].left;
  }
  [[nodiscard]] draw::LineSet lines(PlotId id) {
    return plots().persisted.lines[static_cast<std::size_t>(id)];
  }
  [[nodiscard]] double length_s() {
    return state().transient.time_to_s - state().transient.time_from_s;
  }

  void wheel(float notches) {
    ImGui::GetIO().AddMouseWheelEvent(0.0F, notches);
    frames(3);
  }
  // Between the value axis' labels and the plot.
  void wheel_over_values(const std::string& plot, float notches) {
    const ItemRect area = rect(plot);
    move_to(ImVec2(area.from.x - 10.0F, area.centre().y));
    wheel(notches);
  }
  void double_click() {
    for (int i = 0; i < 2; ++i) {
      ImGui::GetIO().AddMouseButtonEvent(ImGuiMouseButton_Left, true);
      frames(1);
      ImGui::GetIO().AddMouseButtonEvent(ImGuiMouseButton_Left, false);
      frames(1);
    }
    frames(2);
  }
  void drag(ImVec2 from, ImVec2 to, ImGuiMouseButton button = ImGuiMouseButton_Left) {
    move_to(from);
    ImGui::GetIO().AddMouseButtonEvent(button, true);
    frames(2);
    for (const float share : {0.3F, 0.7F, 1.0F}) {
      move_to(ImVec2(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)));
    }
    ImGui::GetIO().AddMouseButtonEvent(button, false);
    frames(2);
  }
  void close_popup() { press(ImGuiKey_Escape); }
};

TEST_F(PlotsPanelTest, TheWheelInAPlotZoomsTimeAndLeavesTheValuesAutomatic) {
  live(7000);
  const double before_s = length_s();
  move_to(rect("plot Force").centre());
  wheel(2.0F);
  EXPECT_LT(length_s(), before_s);
  EXPECT_FALSE(state().transient.follow);
  EXPECT_FALSE(left_axis(PlotId::kForce).manual);
}

TEST_F(PlotsPanelTest, TheWheelOverAValueAxisPutsItAndItStaysWhileTheSessionRuns) {
  press(ImGuiKey_1);
  live(3000);
  wheel_over_values("plot Force", -3.0F);
  const draw::ValueAxis put = left_axis(PlotId::kForce);
  EXPECT_TRUE(put.manual);
  EXPECT_FALSE(left_axis(PlotId::kPosition).manual);
  EXPECT_TRUE(state().transient.follow);
  live(4000);
  EXPECT_EQ(left_axis(PlotId::kForce).minimum, put.minimum);
  EXPECT_EQ(left_axis(PlotId::kForce).maximum, put.maximum);
  EXPECT_DOUBLE_EQ(state().transient.time_to_s, application_->history().newest_time_s());
  click("automatic axes");
  EXPECT_FALSE(left_axis(PlotId::kForce).manual);
  frames(2);
  EXPECT_LT(left_axis(PlotId::kForce).maximum, put.maximum);
}

TEST_F(PlotsPanelTest, ADragOverAValueAxisMovesItAndADoubleClickThereGoesBack) {
  live(3000);
  const ItemRect area = rect("plot Force");
  const ImVec2 axis(area.from.x - 10.0F, area.centre().y);
  drag(axis, ImVec2(axis.x + 40.0F, axis.y + 20.0F));  // into the plot: it stays the axis
  EXPECT_TRUE(left_axis(PlotId::kForce).manual);
  EXPECT_TRUE(state().transient.follow);
  move_to(axis);
  double_click();
  EXPECT_FALSE(left_axis(PlotId::kForce).manual);
  EXPECT_TRUE(state().transient.follow);
}

TEST_F(PlotsPanelTest, ARightDragZoomsIntoARectangle) {
  live(7000);
  const ItemRect area = rect("plot Force");
  const ImVec2 centre = area.centre();
  const double from_s = state().transient.time_from_s;
  drag(centre, ImVec2(area.to.x - 20.0F, area.to.y - 10.0F), ImGuiMouseButton_Right);
  EXPECT_TRUE(left_axis(PlotId::kForce).manual);
  EXPECT_NEAR(state().transient.time_from_s, from_s + 3.0, 0.05);
  EXPECT_FALSE(state().transient.follow);
  move_to(centre);
  double_click();
  EXPECT_FALSE(left_axis(PlotId::kForce).manual);
  EXPECT_TRUE(state().transient.follow);
}

// Without an algorithm the wall chatters: one contact about every 20 ms.
TEST_F(PlotsPanelTest, TheTriggerHoldsTheWindowAtAContact) {
  press(ImGuiKey_1);
  live(3000);
  state().persisted.time_window_s = 0.1;
  click("trigger");
  click("trigger normal");
  EXPECT_EQ(plots().persisted.trigger.mode, TriggerMode::kNormal);
  close_popup();
  live(1000);
  ASSERT_TRUE(plots().transient.trigger.contact_s.has_value());
  const double contact_s = *plots().transient.trigger.contact_s;
  EXPECT_GT(contact_s, 3.5);
  EXPECT_NEAR(state().transient.time_from_s, contact_s - 0.025, 1e-9);
  EXPECT_NEAR(length_s(), 0.1, 1e-9);
  const draw::SampleHistory& history = application_->history();
  const std::size_t index = *history.nearest(contact_s);
  EXPECT_GT(history.value(&Sample::penetration_m, index), 0.0);
  EXPECT_LE(history.value(&Sample::penetration_m, index - 1), 0.0);
}

TEST_F(PlotsPanelTest, SingleFreezesAndArmWaitsForTheNextContact) {
  press(ImGuiKey_1);
  live(3000);
  state().persisted.time_window_s = 0.1;
  click("trigger");
  click("trigger single");
  close_popup();
  live(500);
  EXPECT_EQ(plots().transient.trigger.stage, TriggerStage::kDone);
  EXPECT_FALSE(state().transient.follow);
  const double first_s = *plots().transient.trigger.contact_s;
  live(500);
  EXPECT_EQ(*plots().transient.trigger.contact_s, first_s);
  click("follow");  // it says Arm
  live(500);
  EXPECT_GT(*plots().transient.trigger.contact_s, first_s);
  EXPECT_EQ(plots().transient.trigger.stage, TriggerStage::kDone);
}

TEST_F(PlotsPanelTest, CursorsAreShownDraggedAndHidden) {
  live(7000);
  click("follow");
  press(ImGuiKey_C);
  ASSERT_TRUE(plots().transient.cursors.shown);
  frames(2);
  EXPECT_TRUE(find("cursor table").has_value());
  const auto before_s = plots().transient.cursors.time_s;
  EXPECT_NEAR(before_s[1] - before_s[0], 2.0, 1e-9);  // a third of 6 s
  const ItemRect area = rect("plot Force");
  const float cursor_x = area.from.x + (area.to.x - area.from.x) / 3.0F;
  drag(ImVec2(cursor_x, area.centre().y), ImVec2(area.from.x + 30.0F, area.centre().y));
  EXPECT_LT(plots().transient.cursors.time_s[0], before_s[0] - 0.5);
  EXPECT_EQ(plots().transient.cursors.time_s[1], before_s[1]);
  EXPECT_NEAR(length_s(), 6.0, 1e-9) << "the plot itself has not moved";
  click("cursors");
  EXPECT_FALSE(plots().transient.cursors.shown);
  EXPECT_FALSE(find("cursor table").has_value());
}

TEST_F(PlotsPanelTest, CursorsGoWithTheWindowWhileItFollows) {
  live(7000);
  click("cursors");
  const double before_s = plots().transient.cursors.time_s[0];
  live(1000);
  EXPECT_NEAR(plots().transient.cursors.time_s[0], before_s + 1.0, 1e-6);
}

TEST_F(PlotsPanelTest, WhatOnlyASimulatorKnowsCannotBeChosenOfADevice) {
  with_device = true;
  open("press");
  click("signals Force");
  click("signal hand F_h");
  EXPECT_EQ(lines(PlotId::kForce), draw::usual_lines()[static_cast<std::size_t>(PlotId::kForce)]);
}

TEST_F(PlotsPanelTest, TheLoopTellsItsEnergyOfTheWindowAndOfTheLastContact) {
  press(ImGuiKey_1);
  live(3000);
  click("phase plane");
  frames(2);
  const draw::SampleHistory& history = application_->history();
  const auto exchanged_j = [&](Quantity energy, draw::IndexRange range) {
    return history.value(energy, range.last - 1) - history.value(energy, range.first);
  };
  const draw::IndexRange all = history.range_within(0.0, 10.0);
  EXPECT_LT(plots().transient.phase.energy_j, -0.1) << "the chattering wall gives energy";
  EXPECT_NEAR(plots().transient.phase.energy_j, exchanged_j(&Sample::energy_scv_j, all), 1e-9);
  click("true");
  EXPECT_NEAR(plots().transient.phase.energy_j, exchanged_j(&PlantTruth::actuator_work_j, all),
              1e-9);
  click("last contact");
  frames(1);
  EXPECT_LT(plots().transient.phase.samples, 60U);
  EXPECT_GT(plots().transient.phase.samples, 4U);
  EXPECT_TRUE(find("plot Phase").has_value());
  click("phase plane");
  EXPECT_FALSE(find("plot Phase").has_value());
}

TEST_F(PlotsPanelTest, EverythingAtOnceFitsIntoTheSmallestWindow) {
  live(2000);
  click("phase plane");
  click("cursors");
  press(ImGuiKey_T);
  for (const char* signal : {"actuator work", "losses", "hand's work", "kinetic"}) {
    click("signals Passivity");
    click(std::string("signal ") + signal);
    close_popup();
  }
  live(500);
  for (const auto& [name, item] : drawn_items()) {
    if (item.id == 0) continue;
    EXPECT_GE(item.from.x, 0.0F) << name;
    EXPECT_LE(item.to.x, static_cast<float>(kScreenWidth)) << name;
  }
  for (const char* plot : {"plot Position", "plot Force", "plot Stiffness", "plot Passivity"}) {
    const ItemRect area = rect(plot);
    EXPECT_GT(area.to.x - area.from.x, 100.0F) << plot;
    EXPECT_GT(area.to.y - area.from.y, 40.0F) << plot;
    EXPECT_LE(area.to.y, static_cast<float>(kScreenHeight)) << plot;
  }
}

}  // namespace
}  // namespace hapticwall::test
