// The plots: time, value axes, trigger, cursors and phase plane.
#include "app/ui/page/plots_panel.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using draw::PlotId;
using draw::Quantity;
using draw::TriggerStage;

class PlotsPanelTest : public GuiTest {
 protected:
  [[nodiscard]] ui::PlotsState& plots() { return state().plots; }
  [[nodiscard]] draw::ValueAxis& left_axis(PlotId id) {
    return plots().transient.axes[static_cast<std::size_t>(id)].left;
  }
  [[nodiscard]] draw::LineSet lines(PlotId id) {
    return plots().persisted.lines[static_cast<std::size_t>(id)];
  }
  [[nodiscard]] double length_s() { return state().time.to_s - state().time.from_s; }

  // Between the labels of the value axis and the plot.
  [[nodiscard]] static ImVec2 value_axis(const std::string& plot) {
    const ItemRect area = rect(plot);
    return {area.from.x - 10.0F, area.centre().y};
  }
  void double_click(ImVec2 place) {
    move_to(place);
    for (const bool down : {true, false, true, false}) {
      ImGui::GetIO().AddMouseButtonEvent(ImGuiMouseButton_Left, down);
      frames(1);
    }
    frames(2);
  }
};

TEST_F(PlotsPanelTest, TheLegendOfPositionTakesOneRowInTheUsualWindow) {
  open("tap");
  live(5000);
  for (const char* other : {"legend handle", "legend true position", "signals Position"})
    EXPECT_NEAR(rect("legend hand").from.y, rect(other).from.y, 6.0F) << other;
  EXPECT_TRUE(sees("hand to 65.3 mm ↑")) << "its name, and where it is";
}

TEST_F(PlotsPanelTest, ThePlotsFollowTheNewestSamplesUntilTheWheelZoomsTime) {
  const auto expect_newest = [&] {
    EXPECT_TRUE(state().time.follow);
    EXPECT_DOUBLE_EQ(state().time.to_s, application_->history().newest_time_s());
  };
  live(8000);
  expect_newest();
  EXPECT_NEAR(length_s(), 6.0, 1e-9);
  wheel_at(rect("plot Force").centre(), 2.0F);
  EXPECT_LT(length_s(), 6.0);
  EXPECT_FALSE(state().time.follow);
  EXPECT_FALSE(left_axis(PlotId::kForce).manual);
  const double looked_at_s = state().time.to_s;
  live(1000);
  EXPECT_DOUBLE_EQ(state().time.to_s, looked_at_s);
  click("follow");
  live(100);
  expect_newest();
}

TEST_F(PlotsPanelTest, ThePointerLooksBackInPlotsThatStandStill) {
  live(3000);
  press(ImGuiKey_F);
  ASSERT_FALSE(state().time.follow);
  const ItemRect plot = rect("plot Force");
  const auto newest_s = [&] { return application_->history().newest_time_s(); };
  const double newest_n = application_->history().sample(2999).force_n;
  EXPECT_GT(newest_n, 1.0);
  move_to(ImVec2(plot.from.x + 2.0F, plot.centre().y));
  const double from_s = state().time.from_s;
  ASSERT_TRUE(state().time.looked_at_s);
  frames(1);
  EXPECT_NEAR(*state().time.looked_at_s, from_s, 0.02 * length_s());
  EXPECT_LT(static_cast<double>(state().tails.front().end_tick), 0.05 * 3000.0)
      << "the verdict is that of then";
  EXPECT_TRUE(text().find(fmt::format("{:9.3f} s", newest_s())) == std::string::npos);
  move_away();
  frames(1);
  EXPECT_FALSE(state().time.looked_at_s);
  EXPECT_EQ(state().tails.front().end_tick, 3000U);
  press(ImGuiKey_F);
  move_to(plot.centre());
  EXPECT_FALSE(state().time.looked_at_s) << "the plots follow";
}

TEST_F(PlotsPanelTest, TheWheelOverAValueAxisPutsItAndItStaysWhileTheSessionRuns) {
  press(ImGuiKey_1);
  live(3000);
  wheel_at(value_axis("plot Force"), -3.0F);
  const draw::ValueAxis put = left_axis(PlotId::kForce);
  EXPECT_TRUE(put.manual);
  EXPECT_FALSE(left_axis(PlotId::kPosition).manual);
  EXPECT_TRUE(state().time.follow);
  live(4000);
  EXPECT_EQ(left_axis(PlotId::kForce).minimum, put.minimum);
  EXPECT_EQ(left_axis(PlotId::kForce).maximum, put.maximum);
  EXPECT_DOUBLE_EQ(state().time.to_s, application_->history().newest_time_s());
  click("automatic axes");
  EXPECT_FALSE(left_axis(PlotId::kForce).manual);
  frames(2);
  EXPECT_LT(left_axis(PlotId::kForce).maximum, put.maximum);
}

TEST_F(PlotsPanelTest, ADragOverAValueAxisMovesItAndADoubleClickThereGoesBack) {
  live(3000);
  const ImVec2 axis = value_axis("plot Force");
  drag(axis, ImVec2(axis.x + 40.0F, axis.y + 20.0F));  // into the plot: it stays the axis
  EXPECT_TRUE(left_axis(PlotId::kForce).manual);
  EXPECT_TRUE(state().time.follow);
  double_click(axis);
  EXPECT_FALSE(left_axis(PlotId::kForce).manual);
  EXPECT_TRUE(state().time.follow);
}

TEST_F(PlotsPanelTest, ARightDragZoomsIntoARectangle) {
  live(7000);
  const ItemRect area = rect("plot Force");
  const ImVec2 centre = area.centre();
  const double from_s = state().time.from_s;
  drag(centre, ImVec2(area.to.x - 20.0F, area.to.y - 10.0F), ImGuiMouseButton_Right);
  EXPECT_TRUE(left_axis(PlotId::kForce).manual);
  EXPECT_NEAR(state().time.from_s, from_s + 3.0, 0.05);
  EXPECT_FALSE(state().time.follow);
  double_click(centre);
  EXPECT_FALSE(left_axis(PlotId::kForce).manual);
  EXPECT_TRUE(state().time.follow);
}

// Without an algorithm the wall chatters: one contact about every 20 ms.
TEST_F(PlotsPanelTest, ASingleTriggerHoldsTheWindowAtAContactAndArmWaitsForTheNext) {
  const auto& trigger = plots().transient.trigger;
  press(ImGuiKey_1);
  live(3000);
  state().time.window_s = 0.1;
  click("trigger");
  click("trigger single");
  press(ImGuiKey_Escape);
  live(500);
  EXPECT_EQ(trigger.stage, TriggerStage::kDone);
  EXPECT_FALSE(state().time.follow);
  ASSERT_TRUE(trigger.contact_s.has_value());
  const double first_s = *trigger.contact_s;
  EXPECT_NEAR(state().time.from_s, first_s - 0.025, 1e-9);
  EXPECT_NEAR(length_s(), 0.1, 1e-9);
  const draw::SampleHistory& history = application_->history();
  const std::size_t index = *history.nearest(first_s);
  EXPECT_GT(history.value(&Sample::penetration_m, index), 0.0);
  EXPECT_LE(history.value(&Sample::penetration_m, index - 1), 0.0);
  live(500);
  EXPECT_EQ(*trigger.contact_s, first_s);
  click("follow");  // the button is now called Arm
  live(500);
  EXPECT_GT(*trigger.contact_s, first_s);
  EXPECT_EQ(trigger.stage, TriggerStage::kDone);
}

TEST_F(PlotsPanelTest, CursorsAreShownDraggedAndHidden) {
  live(7000);
  click("follow");
  press(ImGuiKey_C);
  ASSERT_TRUE(plots().transient.cursors.shown);
  frames(2);
  EXPECT_TRUE(sees("cursor table"));
  const auto before_s = plots().transient.cursors.time_s;
  EXPECT_NEAR(before_s[1] - before_s[0], 2.0, 1e-9);  // a third of 6 s
  const ItemRect area = rect("plot Force");
  drag(area.at(1.0F / 3.0F, 0.5F), ImVec2(area.from.x + 30.0F, area.centre().y));
  EXPECT_LT(plots().transient.cursors.time_s[0], before_s[0] - 0.5);
  EXPECT_EQ(plots().transient.cursors.time_s[1], before_s[1]);
  EXPECT_NEAR(length_s(), 6.0, 1e-9) << "the plot itself has not moved";
  click("cursors");
  EXPECT_FALSE(plots().transient.cursors.shown);
  EXPECT_FALSE(sees("cursor table"));
}

TEST_F(PlotsPanelTest, CursorsGoWithTheWindowWhileItFollows) {
  live(7000);
  click("cursors");
  const double before_s = plots().transient.cursors.time_s[0];
  live(1000);
  EXPECT_NEAR(plots().transient.cursors.time_s[0], before_s + 1.0, 1e-6);
}

// None chatters with 3 mm, so that the axes have labels of different widths.
TEST_F(PlotsPanelTest, AllTimeAxesHaveOneLeftAndOneRightMargin) {
  press(ImGuiKey_1);
  click("signals Position");
  click("signal velocity");  // a second axis on the right
  press(ImGuiKey_Escape);
  live(3000);
  const auto margins = [&](PlotId id) {
    const draw::PlotArea& area = plots().transient.axes[static_cast<std::size_t>(id)].area;
    return std::pair(area.position.x, area.position.x + area.size.x);
  };
  EXPECT_EQ(margins(PlotId::kPosition), margins(PlotId::kStiffness));
  EXPECT_EQ(margins(PlotId::kForce), margins(PlotId::kPassivity));
  const auto width = [&](PlotId id) { return margins(id).second - margins(id).first; };
  EXPECT_EQ(width(PlotId::kPosition), width(PlotId::kForce));
}

TEST_F(PlotsPanelTest, TheForceAxisIsThatOfTheActuatorWhateverTheWallWishes) {
  press(ImGuiKey_1);
  live(4000);
  const draw::SampleHistory& history = application_->history();
  const double limit_n = *fake_->scene().x().device.force_limit_n;
  ASSERT_GT(history.extremes(&Sample::wall_force_n, {0, history.size()}).maximum, 3.0 * limit_n);
  EXPECT_GT(left_axis(PlotId::kForce).maximum, limit_n);
  EXPECT_LT(left_axis(PlotId::kForce).maximum, 1.5 * limit_n);
  EXPECT_LE(left_axis(PlotId::kForce).minimum, 0.0);
  EXPECT_GT(left_axis(PlotId::kForce).minimum, -limit_n) << "the wall does not pull";
  state().plots.persisted.hidden_lines |= draw::line_bit(&Sample::force_n);
  frames(1);
  EXPECT_GT(left_axis(PlotId::kForce).maximum, 3.0 * limit_n) << "alone, it is followed";
}

TEST_F(PlotsPanelTest, APositionAtRestIsShownOverTwoCountsAtLeast) {
  state().time.window_s = 0.5;
  press(ImGuiKey_4);
  live(8000);
  const double count_mm = *fake_->scene().x().device.encoder_m * 1e3;
  const draw::ValueAxis& axis = left_axis(PlotId::kPosition);
  EXPECT_GE(axis.maximum - axis.minimum, 2.0 * count_mm);
  EXPECT_LT(axis.maximum - axis.minimum, 4.0 * count_mm);
}

TEST_F(PlotsPanelTest, EnergyIsInJoulesFromAThousandMillijoules) {
  press(ImGuiKey_4);
  live(3000);
  const auto& axes = plots().transient.axes[static_cast<std::size_t>(PlotId::kPassivity)];
  EXPECT_FALSE(axes.large);
  EXPECT_GT(axes.left.maximum - axes.left.minimum, 5.0);
  press(ImGuiKey_1);
  live(9000);
  EXPECT_TRUE(axes.large);
  EXPECT_LT(axes.left.maximum, 10.0);
  EXPECT_GE(axes.left.maximum - axes.left.minimum, 1.0);
}

TEST_F(PlotsPanelTest, ADeviceHasNoSignalsOfTheSimulatedTruth) {
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
  EXPECT_TRUE(sees("plot Phase"));
  click("phase plane");
  EXPECT_FALSE(sees("plot Phase"));
}

TEST_F(PlotsPanelTest, TheSpectrumTellsTheFrequencyOfTheLimitCycle) {
  press(ImGuiKey_1);
  live(9000);  // the hand has come to rest more than a window ago
  EXPECT_TRUE(plots().transient.spectrum.spectrum.amplitude.empty()) << "no transform unless shown";
  click("spectrum");
  live(100);
  const auto& strongest = plots().transient.spectrum.strongest;
  ASSERT_TRUE(strongest.has_value());
  EXPECT_NEAR(strongest->frequency_hz, 49.8, 1.0);
  click("spectrum signal");
  click("spectrum of actuator F_d");
  frames(1);
  EXPECT_NEAR(strongest->frequency_hz, 49.8, 1.0);
  EXPECT_GT(strongest->amplitude, 3.0) << "in N";
  click("spectrum");
  EXPECT_FALSE(sees("spectrum signal"));
}

TEST_F(PlotsPanelTest, EverythingAtOnceFitsIntoTheSmallestWindow) {
  live(2000);
  click("phase plane");
  click("cursors");
  press(ImGuiKey_T);
  for (const char* signal : {"actuator work", "losses", "hand's work", "kinetic"}) {
    click("signals Passivity");
    click(std::string("signal ") + signal);
    press(ImGuiKey_Escape);
  }
  live(500);
  expect_within(kScreenWidth);
  for (const char* plot : {"plot Position", "plot Force", "plot Stiffness", "plot Passivity"}) {
    const ItemRect area = rect(plot);
    EXPECT_GT(area.to.x - area.from.x, 100.0F) << plot;
    EXPECT_GT(area.to.y - area.from.y, 40.0F) << plot;
    EXPECT_LE(area.to.y, static_cast<float>(kScreenHeight)) << plot;
  }
}

}  // namespace
}  // namespace hapticwall::test
