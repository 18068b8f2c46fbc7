// The strip below the views: page tabs and energy lamp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/ui/panel/energy_lamp_view.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using ui::lamp_tone;
using ui::lamp_words;

class EnergyLampStripTest : public GuiTest {
 protected:
  // Runs the script of the scene to its end under an algorithm.
  void run_scene(const std::string& name, const std::string& algorithm) {
    open(name);
    AlgorithmSettings settings = scene().algorithm;
    settings.index = *find_algorithm(algorithm);
    ASSERT_FALSE(fake_->set_algorithm(settings));
    constexpr int kScript = 6000;
    live(kScript);
  }
  [[nodiscard]] const EnergyStory& story() const { return state().compare.transient.lamp->story(); }
  // The story computed directly, from the row before the first contact to the newest.
  [[nodiscard]] EnergyStory story_of_history() const {
    const draw::SampleHistory& history = application_->history();
    EnergyLedger since;
    for (std::size_t i = 0; i < history.size(); ++i) {
      const Sample sample = history.sample(i);
      if ((sample.flags & kFlagInContact) != 0) break;
      since = ledger_of(sample);
    }
    return tell_energy_story(ledger_of(history.sample(history.size() - 1)), since);
  }
  void expect_story_of_history() const {
    const EnergyStory by_hand = story_of_history();
    EXPECT_EQ(story().state, by_hand.state);
    EXPECT_DOUBLE_EQ(story().extracted_j, by_hand.extracted_j);
    EXPECT_DOUBLE_EQ(story().budget_j, by_hand.budget_j);
  }
};

TEST_F(EnergyLampStripTest, UnderNoneTheHoldIsActiveAndTheObserverSeesNothing) {
  run_scene("press", "none");
  expect_story_of_history();
  EXPECT_EQ(story().state, EnergyState::kActive);
  EXPECT_EQ(story().blame, EnergyBlame::kHold);
  EXPECT_GT(newest().energy_cv_j, 1.0) << "the observer is positive";
  const ui::LampWords words = lamp_words(story());
  EXPECT_EQ(lamp_tone(story(), state().tails.front()), draw::Tone::kBad);
  EXPECT_THAT(words.text, StartsWith("the hand has extracted "));
  EXPECT_THAT(words.text, HasSubstr("J, the hold to blame"));
  EXPECT_THAT(words.remark, HasSubstr("observer (Eq. 6) sees nothing"));
}

TEST_F(EnergyLampStripTest, UnderEnergyBoundingASlowPressIsNotActive) {
  run_scene("press", "energy-bounding");
  expect_story_of_history();
  EXPECT_NE(story().state, EnergyState::kActive);
  EXPECT_EQ(story().blame, EnergyBlame::kNobody);
  EXPECT_EQ(lamp_tone(story(), state().tails.front()), draw::Tone::kMuted);
}

TEST_F(EnergyLampStripTest, UnderEnergyBoundingATapIsActiveThroughTheControlLaw) {
  run_scene("tap", "energy-bounding");
  expect_story_of_history();
  EXPECT_EQ(story().state, EnergyState::kActive);
  EXPECT_EQ(story().blame, EnergyBlame::kControlLaw);
  EXPECT_EQ(story().hold_beyond_budget_j, 0.0) << "the bound holds at every row";
  const ui::LampWords words = lamp_words(story());
  EXPECT_THAT(words.text, HasSubstr("the control law to blame"));
  EXPECT_THAT(words.remark, HasSubstr("the hold keeps its bound"));
}

TEST_F(EnergyLampStripTest, TheBudgetIsToldInOneUnit) {
  EnergyStory story;
  EXPECT_EQ(lamp_words(story).text, "passive");
  story.state = EnergyState::kSpendingBudget;
  story.given_out_j = 0.0123;
  story.budget_j = 0.0541;
  EXPECT_EQ(lamp_words(story).text, "spending the budget: 12.3 of 54.1 mJ");
  story.budget_j = 2.5;
  EXPECT_EQ(lamp_words(story).text, "spending the budget: 0.01 of 2.50 J");
  EXPECT_EQ(lamp_words(story).remark, "");
}

TEST_F(EnergyLampStripTest, TellsTheToleranceWhereItDecides) {
  const EnergyLedger now{.cv_j = 0.0, .hold_j = -0.0306, .scv_j = -0.0306, .budget_j = -0.0292};
  const EnergyStory story = tell_energy_story(now, {}, 0.002);
  EXPECT_EQ(story.state, EnergyState::kSpendingBudget);
  EXPECT_EQ(lamp_words(story).text, "spending the budget: 30.6 of 29.2 mJ");
  EXPECT_EQ(lamp_words(story).remark, "within one encoder count, 2.0 mJ");
}

TEST_F(EnergyLampStripTest, BothToBlameIsToldWithBothFigures) {
  EnergyStory story;
  story.state = EnergyState::kActive;
  story.blame = EnergyBlame::kBoth;
  story.extracted_j = 0.05;
  story.hold_beyond_budget_j = 0.02;
  story.control_law_j = 0.03;
  const ui::LampWords words = lamp_words(story);
  EXPECT_EQ(words.text, "the hand has extracted 50.0 mJ, the hold and the control law to blame");
  EXPECT_EQ(words.remark, "the hold 20.0 mJ, the control law 30.0 mJ");
}

TEST_F(EnergyLampStripTest, TheTooltipSaysHowItIsComputed) {
  const std::string text = ui::lamp_tooltip({}, 0.25);
  for (const char* part : {"E_scv = E_cv + E_hold (Eq. 10)", "T Σ b v²", "0.250 s", "Eq. 6"})
    EXPECT_THAT(text, HasSubstr(part));
}

TEST_F(EnergyLampStripTest, StaysInsideANarrowWindow) {
  run_scene("tap", "energy-bounding");
  for (const float width : {1000.0F, 1280.0F}) {
    ImGui::GetIO().DisplaySize.x = width;
    frames(3);
    const ui::LampWords words = lamp_words(state().compare.transient.lamp->story());
    const ItemRect lamp = rect(sees(words.text) ? words.text : words.shorter);
    EXPECT_LE(lamp.to.x, width) << width;
    EXPECT_GT(lamp.to.x - lamp.from.x, 60.0F) << "more than one word";
    EXPECT_GT(lamp.from.x, rect("layout").to.x);
  }
}

TEST_F(EnergyLampStripTest, StartsAnewWithASessionAndAnotherEncoder) {
  run_scene("press", "none");
  ASSERT_EQ(story().state, EnergyState::kActive);
  click_figure("Figure 6");
  EXPECT_EQ(story().state, EnergyState::kPassive);
  live(3000);
  Scene finer = scene();
  finer.x().device.encoder_m = 1e-5;
  ASSERT_FALSE(fake_->change_scene(finer));
  live(10);
  EXPECT_EQ(state().compare.transient.lamp_encoder_m, 1e-5);
}

}  // namespace
}  // namespace hapticwall::test
