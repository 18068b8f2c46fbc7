// The popup of derived signals, and their lines in plots, cursors, spectrum and settings.
#include "app/ui/page/derived_controls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <future>
#include <string>

#include "app/draw/figure/figure.h"
#include "app/draw/plot/derived_signals.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using draw::DerivedKind;
using draw::DerivedSignal;
using draw::PlotId;
using draw::Quantity;
using ::testing::HasSubstr;

constexpr Quantity kFirst = Quantity::derived_signal(0);

class DerivedControlsTest : public GuiTest {
 protected:
  [[nodiscard]] ui::PlotsState::Persisted& plots() { return state().plots.persisted; }
  void choose(const std::string& list, const std::string& name) {
    click("derived " + list);
    click("derived " + list + " " + name);
  }
  // In the open popup.
  void add() { click("add derived"); }
  void add_derivative_of_handle() {
    click("derived");
    add();
    press(ImGuiKey_Escape);
    frames(2);
  }
};

TEST_F(DerivedControlsTest, ADerivativeIsALineOfItsPlotUntilItIsRemoved) {
  live(3000);
  EXPECT_FALSE(sees("legend derivative(handle)"));
  add_derivative_of_handle();
  EXPECT_TRUE(sees("legend derivative(handle)"));
  EXPECT_THAT(text(), HasSubstr("Position"));
  const draw::SampleHistory& history = application_->history();
  ASSERT_EQ(history.derived()[0], DerivedSignal());
  for (const std::size_t i : {1U, 500U, 2999U})
    EXPECT_NEAR(history.value(kFirst, i), history.value(&Sample::velocity_m_per_s, i), 1e-9);
  live(500);
  EXPECT_NEAR(history.value(kFirst, 3400), history.value(&Sample::velocity_m_per_s, 3400), 1e-9);
  const auto& axes = state().plots.transient.axes[static_cast<std::size_t>(PlotId::kPosition)];
  EXPECT_GT(axes.right.maximum, 1.0) << "mm/s";
  click("derived");
  click("remove derivative(handle)");
  press(ImGuiKey_Escape);
  frames(2);
  EXPECT_FALSE(sees("legend derivative(handle)"));
  EXPECT_EQ(history.derived(), draw::DerivedSignals());
}

TEST_F(DerivedControlsTest, TheFormOffersWhatTheKindNeeds) {
  click("derived");
  EXPECT_FALSE(sees("derived minus"));
  EXPECT_FALSE(sees("derived over"));
  choose("kind", "difference");
  choose("of", "actuator F_d");
  choose("minus", "wall F_e");
  EXPECT_FALSE(sees("derived over"));
  add();
  EXPECT_EQ(plots().derived[0], (DerivedSignal{DerivedKind::kDifference, &Sample::force_n,
                                               &Sample::wall_force_n, 0.1}));
  choose("kind", "mean");
  EXPECT_FALSE(sees("derived minus"));
  type("derived over", "0.25");
  add();
  EXPECT_EQ(derived_name(*plots().derived[1]), "mean(actuator F_d over 0.25 s)");
  EXPECT_FALSE(refusal().has_value());
}

TEST_F(DerivedControlsTest, ARefusalStandsUnderTheFieldsAndNothingIsAdded) {
  click("derived");
  choose("kind", "difference");
  choose("of", "actuator F_d");
  add();
  ASSERT_TRUE(refusal().has_value());
  EXPECT_THAT(text(), HasSubstr("actuator F_d is in N, handle in mm"));
  choose("kind", "mean");
  type("derived over", "7");
  add();
  EXPECT_THAT(text(), HasSubstr("one tick (0.001 s) to the length of the time axes (6 s)"));
  EXPECT_EQ(plots().derived, draw::DerivedSignals());
  type("derived over", "0.5");
  add();
  EXPECT_TRUE(plots().derived[0].has_value());
  EXPECT_FALSE(refusal().has_value());
  add();
  EXPECT_THAT(text(), HasSubstr("there already"));
}

TEST_F(DerivedControlsTest, ThereIsRoomForFour) {
  click("derived");
  for (const char* signal : {"handle", "hand", "actuator F_d"}) {
    choose("of", signal);
    add();
  }
  EXPECT_TRUE(sees("add derived"));
  choose("of", "wall F_e");
  add();
  EXPECT_FALSE(sees("add derived"));
  click("remove derivative(hand)");
  EXPECT_TRUE(sees("add derived"));
}

TEST_F(DerivedControlsTest, ALineInAPlotThatIsNotShownIsTold) {
  state().persisted.arrangement = ui::PlotArrangement::kTwo;
  click("derived");
  choose("of", "handle");
  add();
  EXPECT_TRUE(message().text.empty());
  state().plots.transient.next_derived.a = &Sample::energy_hold_j;
  add();
  EXPECT_THAT(message().text, HasSubstr("derivative(hold (9)) is in the plot Passivity"));
}

TEST_F(DerivedControlsTest, CursorsAndSpectrumReadItAndTheSpectrumForgetsItWhenItIsRemoved) {
  press(ImGuiKey_1);
  live(9000);  // the limit cycle
  add_derivative_of_handle();
  click("cursors");
  click("spectrum");
  click("spectrum signal");
  click("spectrum of derivative(handle)");
  frames(1);
  EXPECT_EQ(plots().spectrum.quantity, kFirst);
  EXPECT_NEAR(state().plots.transient.spectrum.strongest->frequency_hz, 49.8, 1.0);
  EXPECT_THAT(text(), HasSubstr("derivative(handle)"));
  click("derived");
  click("remove derivative(handle)");
  frames(1);
  EXPECT_EQ(plots().spectrum.quantity, Quantity(&Sample::position_m));
  EXPECT_TRUE(plots().spectrum.shown);
}

TEST_F(DerivedControlsTest, AFigureShowsIt) {
  live(3000);
  plots().derived[0] = DerivedSignal{DerivedKind::kMean, &Sample::force_n, &Sample::force_n, 0.05};
  plots().derived[1] = DerivedSignal{DerivedKind::kDerivative, &Sample::wall_force_n};
  frames(1);
  constexpr std::array kForceOnly{PlotId::kForce};
  constexpr draw::FigureSize kSize{800, 400};
  draw::FigureView view;
  view.window = {0.0, 3.0};
  view.plots = kForceOnly;
  const auto count = [&](Quantity quantity) {
    view.lines[static_cast<std::size_t>(PlotId::kForce)] = draw::line_bit(quantity);
    const auto figure = std::async(std::launch::async, [&] {
                          return draw::draw_figure(scene(), application_->history(), view, kSize);
                        }).get();
    EXPECT_TRUE(figure.ok());
    if (!figure) return 0;
    const ItemRect below_title{ImVec2(0.0F, 110.0F), ImVec2(kSize.width, kSize.height)};
    return count_tone(*figure, draw::Tone::kHand, below_title, draw::Look::kPrint);
  };
  EXPECT_EQ(count(kFirst), 0) << "its tone is that of the text";
  EXPECT_GT(count(Quantity::derived_signal(1)), 100);
}

}  // namespace
}  // namespace hapticwall::test
