// When the force of a real device may act.
#include "app/session/loop/arming.h"

#include <gtest/gtest.h>

#include "tests/app/session/loop/loop_bench.h"

namespace hapticwall::session::test {
namespace {

constexpr double kRateHz = 1000.0;
constexpr int kRampTicks = 500;

void ticks(Arming& arming, int count, const ArmingFacts& facts = {}) {
  for (int i = 0; i < count; ++i) arming.after_tick(facts);
}

Arming armed() {
  Arming arming(true, kRateHz);
  arming.ask();
  ticks(arming, kRampTicks + 1);
  EXPECT_EQ(arming.state(), ArmingState::kOn);
  return arming;
}

TEST(Arming, ASimulatorNeverNeedsIt) {
  Arming arming(false, kRateHz);
  EXPECT_EQ(arming.gain(), 1.0);
  EXPECT_FALSE(arming.after_tick({.fault = true}));
  arming.disarm(ArmingNote::kAsked);
  EXPECT_EQ(arming.state(), ArmingState::kNotNeeded);
  EXPECT_EQ(arming.gain(), 1.0);
}

// The note of a force while disarmed does not hide the reason of a disarming.
TEST(Arming, AForceWhileDisarmedIsNamed) {
  const ArmingFacts unasked{.judged = ArmingNote::kUnaskedForce};
  Arming off(true, kRateHz);
  ticks(off, 1, unasked);
  EXPECT_EQ(off.note(), ArmingNote::kUnaskedForce);
  Arming late = armed();
  ticks(late, 1, {.judged = ArmingNote::kOtherForce});
  ticks(late, 1, unasked);
  EXPECT_EQ(late.note(), ArmingNote::kOtherForce);
}

TEST(ArmingStatus, MostOfTheTimeIsMoreThanHalfOfASecondOrMore) {
  EXPECT_FALSE((ArmingStatus{.armed_ticks = 999, .limit_ticks = 999}.mostly_at_limit(1000.0)));
  EXPECT_FALSE((ArmingStatus{.armed_ticks = 1000, .limit_ticks = 500}.mostly_at_limit(1000.0)));
  EXPECT_TRUE((ArmingStatus{.armed_ticks = 1000, .limit_ticks = 501}.mostly_at_limit(1000.0)));
}

TEST(Arming, IsOffUntilAskedFor) {
  Arming arming(true, kRateHz);
  ticks(arming, 1000);
  EXPECT_EQ(arming.state(), ArmingState::kOff);
  EXPECT_EQ(arming.gain(), 0.0);
  EXPECT_FALSE(arming.enabled());
}

TEST(Arming, RisesEvenlyOverHalfASecond) {
  Arming arming(true, kRateHz);
  arming.ask();
  double before = arming.gain();
  for (int tick = 0; tick < kRampTicks; ++tick) {
    EXPECT_FALSE(arming.after_tick({}));
    EXPECT_NEAR(arming.gain() - before, 1.0 / kRampTicks, 1e-12);
    before = arming.gain();
  }
  ticks(arming, 1);
  EXPECT_EQ(arming.gain(), 1.0);
  EXPECT_EQ(arming.state(), ArmingState::kOn);
  EXPECT_EQ(arming.answers(), 1U);
}

TEST(Arming, IsRefusedWhereItMustNotBe) {
  struct Case {
    ArmingFacts facts;
    ArmingNote note;
  };
  for (const Case& one :
       {Case{{.in_contact = true}, ArmingNote::kInsideWall},
        Case{{.fault = true}, ArmingNote::kNotReady}, Case{{.stale = true}, ArmingNote::kNotReady},
        Case{{.stale = true, .in_contact = true}, ArmingNote::kNotReady},
        Case{{.failed = true}, ArmingNote::kForce}}) {
    Arming arming(true, kRateHz);
    arming.ask();
    arming.after_tick(one.facts);
    EXPECT_EQ(arming.state(), ArmingState::kOff);
    EXPECT_EQ(arming.note(), one.note);
    EXPECT_EQ(arming.answers(), 1U);
    ticks(arming, 10);  // a refusal is final, even if its cause disappears
    EXPECT_FALSE(arming.enabled());
  }
}

TEST(Arming, EveryFaultTakesTheForceAwayForGood) {
  struct Case {
    ArmingFacts facts;
    ArmingNote note;
  };
  for (const Case& one :
       {Case{{.fault = true}, ArmingNote::kDevice}, Case{{.stale = true}, ArmingNote::kStale},
        Case{{.failed = true}, ArmingNote::kForce},
        Case{{.in_contact = true, .parameters_changed = true}, ArmingNote::kWallMoved}}) {
    Arming arming = armed();
    EXPECT_TRUE(arming.after_tick(one.facts));
    EXPECT_EQ(arming.note(), one.note);
    EXPECT_EQ(arming.gain(), 0.0);
    ticks(arming, 1000);
    EXPECT_FALSE(arming.enabled());
    arming.ask();
    ticks(arming, 1);
    EXPECT_EQ(arming.state(), ArmingState::kRamping);
    EXPECT_EQ(arming.note(), ArmingNote::kNone);
  }
}

TEST(Arming, ContactAndChangesOfTheWallInsideItAreWhatItIsFor) {
  Arming arming = armed();
  ticks(arming, 1, {.in_contact = true});
  ticks(arming, 1, {.in_contact = true, .parameters_changed = true});
  ticks(arming, 1, {.parameters_changed = true});
  EXPECT_EQ(arming.state(), ArmingState::kOn);
}

TEST(Arming, EveryNoteHasWords) {
  for (std::size_t note = 1; note < kArmingNoteTexts.size(); ++note) {
    EXPECT_FALSE(arming_note_text(static_cast<ArmingNote>(note)).empty()) << note;
  }
  EXPECT_TRUE(arming_note_text(ArmingNote::kNone).empty());
}

}  // namespace
}  // namespace hapticwall::session::test
