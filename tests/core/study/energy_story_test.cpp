// The lamp: what a ledger says, term by term, and where the story begins.
#include "core/study/energy_story.h"

#include <gtest/gtest.h>

namespace hapticwall {
namespace {

EnergyLedger ledger(double cv_j, double hold_j, double budget_j) {
  return {cv_j, hold_j, cv_j + hold_j, budget_j};
}

TEST(EnergyStory, SaysOfEachLedgerHowMuchAndOfWhichTerm) {
  constexpr EnergyState kPassive = EnergyState::kPassive;
  constexpr EnergyState kActive = EnergyState::kActive;
  struct Case {
    const char* what;
    EnergyLedger ledger;
    EnergyState state;
    EnergyBlame blame;
    double extracted_j, hold_beyond_budget_j, control_law_j;
  };
  const Case cases[] = {
      {"nothing", {}, kPassive, EnergyBlame::kNobody, 0.0, 0.0, 0.0},
      {"the law has paid for the hold", ledger(0.04, -0.03, -0.05), kPassive, EnergyBlame::kNobody,
       0.0, 0.0, 0.0},
      {"the damping has paid for it", ledger(0.01, -0.03, -0.05), EnergyState::kSpendingBudget,
       EnergyBlame::kNobody, 0.0, 0.0, 0.0},
      {"the hold, of which the algorithm has paid 0.1", ledger(0.1, -0.5, -0.1), kActive,
       EnergyBlame::kHold, 0.3, 0.4, 0.0},
      {"the control law", ledger(-1.0, -0.1, -0.3), kActive, EnergyBlame::kControlLaw, 0.8, 0.0,
       1.0},
      {"both", ledger(-0.2, -0.5, -0.1), kActive, EnergyBlame::kBoth, 0.6, 0.4, 0.2},
      {"the hold, and the algorithm covers it", ledger(1.0, -0.5, -0.1), kPassive,
       EnergyBlame::kNobody, 0.0, 0.4, 0.0}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    const EnergyStory story = tell_energy_story(one.ledger);
    EXPECT_EQ(story.state, one.state);
    EXPECT_EQ(story.blame, one.blame);
    EXPECT_DOUBLE_EQ(story.extracted_j, one.extracted_j);
    EXPECT_DOUBLE_EQ(story.hold_beyond_budget_j, one.hold_beyond_budget_j);
    EXPECT_DOUBLE_EQ(story.control_law_j, one.control_law_j);
  }
  const EnergyStory spent = tell_energy_story(ledger(0.01, -0.03, -0.05));
  EXPECT_DOUBLE_EQ(spent.given_out_j, 0.02);
  EXPECT_DOUBLE_EQ(spent.budget_j, 0.05);
}

TEST(EnergyStory, BelowWhatTheEncoderResolvesNothingIsActive) {
  const EnergyLedger now = ledger(-0.001, 0.0, 0.0);
  EXPECT_EQ(tell_energy_story(now, {}, 0.002).state, EnergyState::kPassive);
  EXPECT_EQ(tell_energy_story(now, {}, 0.0005).state, EnergyState::kActive);
}

TEST(EnergyStory, RoundingIsNoActivity) {
  EnergyLedger now = ledger(1.0, -1.0, 0.0);
  now.scv_j = -1e-15;
  EXPECT_EQ(tell_energy_story(now).state, EnergyState::kPassive);
}

TEST(EnergyStory, OnlyWhatHappenedSinceCounts) {
  const EnergyLedger since = ledger(0.5, -3.0, -0.1);
  const EnergyStory story = tell_energy_story(ledger(0.6, -3.05, -0.2), since);
  EXPECT_EQ(story.state, EnergyState::kPassive);
  EXPECT_NEAR(story.budget_j, 0.1, 1e-15);
}

TEST(EnergyStory, WhereNeitherTermIsLargeAloneTheLargerOneIsNamed) {
  EXPECT_EQ(tell_energy_story(ledger(-0.6, -0.7, 0.0), {}, 1.0).blame, EnergyBlame::kHold);
  EXPECT_EQ(tell_energy_story(ledger(-0.7, -0.6, 0.0), {}, 1.0).blame, EnergyBlame::kControlLaw);
}

// A lamp that is shown samples of a device without encoder at 1 kHz: rests for 250 ticks.
class Lamp : public ::testing::Test {
 protected:
  const EnergyStory& show(const EnergyLedger& now, double force_n, double penetration_m,
                          std::uint32_t more_flags = 0) {
    Sample sample;
    sample.tick = tick_++;
    sample.energy_cv_j = now.cv_j;
    sample.energy_hold_j = now.hold_j;
    sample.energy_scv_j = now.scv_j;
    sample.energy_budget_j = now.budget_j;
    sample.force_n = force_n;
    sample.penetration_m = penetration_m;
    sample.flags = more_flags | (penetration_m > 0.0 ? std::uint32_t{kFlagInContact} : 0U);
    lamp_.add(sample);
    return lamp_.story();
  }
  void show_free_motion(const EnergyLedger& now, int ticks) {
    for (int i = 0; i < ticks; ++i) show(now, 0.0, -0.01);
  }

  EnergyLamp lamp_{1000.0, 0.0};
  std::uint64_t tick_ = 0;
};

TEST_F(Lamp, FreeMotionLendsTheContactNoBudget) {
  show_free_motion(ledger(0.0, 0.0, -5.0), 10);
  EXPECT_EQ(show(ledger(0.1, -0.5, -5.1), 1.0, 0.001).state, EnergyState::kActive);
  EXPECT_EQ(lamp_.since_tick(), 9U);
}

TEST_F(Lamp, AChatteringContactIsOneStory) {
  show_free_motion({}, 300);
  show(ledger(0.1, -0.5, -0.1), 1.0, 0.001);
  show_free_motion(ledger(0.1, -0.5, -0.1), 249);
  const EnergyStory story = show(ledger(0.1, -0.6, -0.1), 1.0, 0.001);
  EXPECT_NEAR(story.extracted_j, 0.4, 1e-15);
  EXPECT_EQ(lamp_.since_tick(), 299U);
}

TEST_F(Lamp, AContactAfterARestBeginsAnewAndTheLastOneIsToldUntilThen) {
  show(ledger(0.1, -0.5, -0.1), 1.0, 0.001);
  const EnergyLedger after = ledger(0.1, -0.9, -0.1);
  show_free_motion(after, 250);
  EXPECT_EQ(lamp_.story().state, EnergyState::kActive);
  EXPECT_EQ(show(ledger(0.2, -0.9, -0.1), 1.0, 0.001).state, EnergyState::kPassive);
}

TEST_F(Lamp, AForceOutsideTheWallIsNoRest) {
  show({}, 1.0, 0.001);
  for (int i = 0; i < 500; ++i) show({}, 0.5, -0.001);
  show({}, 1.0, 0.001);
  EXPECT_EQ(lamp_.since_tick(), 0U);
}

TEST_F(Lamp, AChangeOfParametersBeginsAnewAndLendsWhatTheWallStores) {
  show({}, 0.0, -0.01);
  show(ledger(0.1, -0.9, 0.0), 4.0, 0.002);  // F p/2 = 4 mJ
  const EnergyLedger released = ledger(0.1 - 0.004, -0.9, 0.0);
  EXPECT_EQ(show(ledger(0.1, -0.9, 0.0), 4.0, 0.002, kFlagParametersChanged).state,
            EnergyState::kPassive);
  EXPECT_EQ(show(released, 0.0, -0.001).state, EnergyState::kPassive);
  const EnergyStory story = show(ledger(0.1 - 0.005, -0.9, 0.0), 0.0, -0.001);
  EXPECT_EQ(story.blame, EnergyBlame::kControlLaw);
  EXPECT_NEAR(story.extracted_j, 0.001, 1e-12);
}

TEST_F(Lamp, AResetBeginsAnew) {
  show_free_motion({}, 5);
  show(ledger(-1.0, 0.0, 0.0), 1.0, 0.001);
  EXPECT_EQ(lamp_.story().state, EnergyState::kActive);
  tick_ = 0;
  EXPECT_EQ(show({}, 0.0, -0.01).state, EnergyState::kPassive);
  EXPECT_EQ(lamp_.since_tick(), 0U);
}

}  // namespace
}  // namespace hapticwall
