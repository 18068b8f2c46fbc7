#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ui::MessageKind;

class ApplicationTest : public GuiTest {
 protected:
  [[nodiscard]] std::string_view algorithm() const {
    return algorithms()[scene().algorithm.index].name;
  }
};

TEST_F(ApplicationTest, ASceneFromElsewhereNamesNoOtherFolder) {
  Scene wanted = scene();
  wanted.name = "../../x";
  state().scene.wanted = ui::WantedScene{wanted, true};
  frames(2);
  ASSERT_EQ(scene().name, wanted.name);
  click("record");
  EXPECT_EQ(fake_->recording_status().path, "_.-..-x-energy-bounding.csv");
}

TEST_F(ApplicationTest, AFailedRecordingStatesTheReason) {
  fake_->refuse_recording = "the disk is full";
  click("record");
  EXPECT_EQ(message().kind, MessageKind::kProblem);
  EXPECT_EQ(message().text, "the disk is full");
  click("message");
  EXPECT_EQ(message().kind, MessageKind::kNone);
}

TEST_F(ApplicationTest, AnInvalidValueIsExplainedAndTheOldOneStays) {
  const Scene before = scene();
  for (const auto& [typed, said] :
       {std::pair{"-5", "out of range"}, std::pair{"1e99", "out of range"},
        std::pair{"stiff", "'stiff' is not a number"}, std::pair{"nan", "'nan' is not a number"},
        std::pair{"35,000", "no thousands separator"}}) {
    type("stiffness", typed);
    ASSERT_TRUE(refusal());
    EXPECT_EQ(refusal()->key, "stiffness");
    EXPECT_THAT(refusal()->why, HasSubstr(said));
    ASSERT_TRUE(sees(refusal()->why));
    EXPECT_GE(rect(refusal()->why).from.y, rect("stiffness").to.y) << "under the field,";
    EXPECT_LE(rect(refusal()->why).to.y, rect("damping").from.y) << "in a line";
    EXPECT_TRUE(ui::same_scene(scene(), before)) << typed;
  }
}

TEST_F(ApplicationTest, NoGapStandsBelowTheParametersOfAnAlgorithm) {
  state().compare.persisted.open = true;
  for (const AlgorithmDescription& algorithm : algorithms()) {
    click(std::string(algorithm.name));
    EXPECT_LT(rect("section Compare").from.y - rect("algorithm.then").to.y, 30.0F)
        << algorithm.name;
  }
}

TEST_F(ApplicationTest, NumbersAreTakenAsPeopleTypeThem) {
  type("stiffness", "12k");
  EXPECT_EQ(wall().stiffness_n_per_m, 12000.0);
  type("stiffness", "35000,5");
  EXPECT_EQ(wall().stiffness_n_per_m, 35000.5);
  EXPECT_FALSE(refusal());
}

TEST_F(ApplicationTest, ANewRateStartsANewSessionAtRestAndABadOneDoesNot) {
  live(500);
  type("rate", "2000");
  EXPECT_EQ(sessions, 2);
  EXPECT_DOUBLE_EQ(scene().sampling.rate_hz, 2000.0);
  EXPECT_EQ(newest().tick, 0U);
  EXPECT_TRUE(application_->history().empty());
  type("rate", "-1");
  EXPECT_EQ(sessions, 2);
  EXPECT_THAT(message().text, HasSubstr("rate_hz"));
  EXPECT_DOUBLE_EQ(scene().sampling.rate_hz, 2000.0);
}

TEST_F(ApplicationTest, IntegratorAndSubstepsChangeDuringTheSession) {
  live(300);
  click("integrator");
  click("semi-implicit-euler");
  EXPECT_EQ(scene().simulator.integrator, Integrator::kSemiImplicitEuler);
  type("substeps", "20");
  EXPECT_EQ(scene().simulator.substeps, 20);
  for (const char* bad : {"1e9", "0"}) {
    type("substeps", bad);
    EXPECT_EQ(scene().simulator.substeps, 20);
    ASSERT_TRUE(refusal().has_value());
    EXPECT_THAT(refusal()->why, HasSubstr("1 to 1000"));
  }
  type("substeps", "2.5");
  EXPECT_EQ(scene().simulator.substeps, 20);
  EXPECT_THAT(refusal()->why, HasSubstr("no whole number"));
  click("integrator");
  click("rk4");
  EXPECT_EQ(scene().simulator.substeps, 20) << "the substeps stay";
  EXPECT_FALSE(refusal().has_value());
  click("integrator");
  click("exact");
  EXPECT_EQ(scene().simulator, SimulatorSettings{});
  live(100);
  EXPECT_EQ(sessions, 1) << "no change needed a new session";
  EXPECT_EQ(application_->history().size(), 400U);
}

TEST_F(ApplicationTest, ASessionThatDoesNotStartLeavesTheOldOne) {
  refuse_session = "no loop to be had";
  type("rate", "2000");
  EXPECT_EQ(message().text, "no loop to be had");
  EXPECT_DOUBLE_EQ(application_->session().scene().sampling.rate_hz, 1000.0);
}

TEST_F(ApplicationTest, TheHandsScriptIsChangedByTyping) {
  click("section Hand");
  type("end position", "70");
  EXPECT_EQ(sessions, 2);
  EXPECT_DOUBLE_EQ(scene().x().hand->path.back().position_m, 0.07);
  type("approach speed", "20");
  EXPECT_EQ(sessions, 3);
  EXPECT_NEAR(scene().x().hand->path.back().time_s, 2.0, 1e-12);  // 40 mm at 20 mm/s
  type("approach speed", "0");
  EXPECT_EQ(sessions, 3);
  ASSERT_TRUE(refusal());
  EXPECT_EQ(refusal()->key, "approach speed");
}

TEST_F(ApplicationTest, TheFigureButtonsStartPressFromRestUnderThePapersAlgorithms) {
  struct Case {
    const char* button;
    const char* algorithm;
    const char* shown;
    const char* not_shown;
  };
  for (const Case& figure :
       {Case{"Figure 4", "none", "plot Passivity", "plot Stiffness"},
        Case{"Figure 5", "virtual-coupling", "plot Stiffness", "plot Passivity"},
        Case{"Figure 6", "energy-bounding", "plot Stiffness", "plot Passivity"}}) {
    live(300);
    const int before = sessions;
    click_figure(figure.button);
    EXPECT_EQ(sessions, before + 1);
    EXPECT_EQ(scene().name, "press");
    EXPECT_EQ(algorithm(), figure.algorithm);
    EXPECT_EQ(newest().tick, 0U);
    EXPECT_TRUE(sees(figure.shown));
    EXPECT_FALSE(sees(figure.not_shown));
  }
}

TEST_F(ApplicationTest, EverySampleOfTheSessionReachesTheHistory) {
  fake_->advance(20000);
  frames(1);
  ASSERT_EQ(application_->history().size(), 20000U);
  click("reset");
  fake_->advance(10);
  frames(1);
  EXPECT_EQ(application_->history().size(), 10U);
}

TEST_F(ApplicationTest, TheScreenShowsTheLinesOfEveryPlot) {
  press(ImGuiKey_1);
  state().plots.persisted.hidden_lines =
      draw::line_bit(&PlantTruth::position_m);  // dots on the handle's
  live(5000);
  move_away();
  const file::Picture picture = screen();
  const auto count = [&](const char* plot, draw::Tone tone) {
    return count_tone(picture, tone, rect(plot));
  };
  constexpr int kEnoughPixels = 100;
  EXPECT_GT(count("plot Position", draw::Tone::kPosition), kEnoughPixels);
  EXPECT_GT(count("plot Force", draw::Tone::kForce), kEnoughPixels);
  EXPECT_GT(count("plot Stiffness", draw::Tone::kStiffness), kEnoughPixels);
  EXPECT_GT(count("plot Passivity", draw::Tone::kObserver), kEnoughPixels);
}

}  // namespace
}  // namespace hapticwall::test
