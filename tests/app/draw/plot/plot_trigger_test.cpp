#include "app/draw/plot/plot_trigger.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace hapticwall::draw {
namespace {

constexpr double kTriggerPeriodS = 1e-3;

// A handle that is in the wall from tick `from` to tick `to` (exclusive).
struct Touch {
  std::uint64_t from = 0;
  std::uint64_t to = 0;
};

class TriggerTest : public ::testing::Test {
 protected:
  void live_until(std::uint64_t end) {
    for (; next_ < end; ++next_) {
      Sample sample;
      sample.tick = next_;
      sample.time_s = static_cast<double>(next_) * kTriggerPeriodS;
      sample.penetration_m = -1e-3;
      for (const Touch& touch : touches) {
        if (next_ >= touch.from && next_ < touch.to) sample.penetration_m = 1e-4;
      }
      history_.push(sample);
    }
  }
  std::optional<TimeWindow> frame() { return run_trigger(history_, settings, length_s, trigger); }

  std::vector<Touch> touches;
  TriggerSettings settings{TriggerMode::kNormal, 0.25};
  double length_s = 1.0;
  Trigger trigger;
  std::uint64_t next_ = 0;
  SampleHistory history_{100000};
};

TEST_F(TriggerTest, TheNewestContactIsTheOneThatBeganLast) {
  touches = {{100, 150}, {300, 310}, {500, 1000}};
  live_until(700);
  const auto contact = newest_contact(history_, {0, 700});
  ASSERT_TRUE(contact.has_value());
  EXPECT_EQ(contact->first, 500U);
  EXPECT_EQ(contact->last, 700U);  // it goes on
  EXPECT_EQ(newest_contact(history_, {0, 400})->first, 300U);
  EXPECT_EQ(newest_contact(history_, {0, 400})->last, 310U);
  EXPECT_FALSE(newest_contact(history_, {0, 100}).has_value());
  EXPECT_FALSE(newest_contact(history_, {550, 700}).has_value());  // it began before
  EXPECT_FALSE(newest_contact(history_, {0, 0}).has_value());
}

TEST_F(TriggerTest, NormalStandsAtTheContactWithItsShareBefore) {
  touches = {{2000, 2100}};
  live_until(1990);
  EXPECT_FALSE(frame().has_value());
  EXPECT_EQ(trigger.stage, TriggerStage::kWaiting);
  live_until(2010);
  const auto window = frame();
  ASSERT_TRUE(window.has_value());
  EXPECT_NEAR(window->from_s, 1.75, 1e-9);
  EXPECT_NEAR(window->to_s, 2.75, 1e-9);
  EXPECT_EQ(trigger.stage, TriggerStage::kFilling);
  live_until(2800);
  EXPECT_NEAR(frame()->from_s, 1.75, 1e-9);
  EXPECT_EQ(trigger.stage, TriggerStage::kShown);
  live_until(90000);  // nothing else happens
  EXPECT_NEAR(frame()->from_s, 1.75, 1e-9);
}

TEST_F(TriggerTest, AContactWhileTheWindowFillsDoesNotMoveItAndTheNextOneDoes) {
  touches = {{2000, 2100}, {2200, 2300}, {4000, 4100}};
  live_until(2050);
  ASSERT_TRUE(frame());
  live_until(2400);
  EXPECT_NEAR(frame()->from_s, 1.75, 1e-9);
  live_until(2760);  // full: now the second one may have it
  EXPECT_NEAR(frame()->from_s, 1.95, 1e-9);
  live_until(4010);
  EXPECT_NEAR(frame()->from_s, 3.75, 1e-9);
}

TEST_F(TriggerTest, AShortWindowIsShownOnlyWhenItIsFull) {
  length_s = 0.1;
  touches = {{1000, 1010}, {1050, 1060}};
  live_until(1060);  // 0.075 s after the first contact are not over
  EXPECT_FALSE(frame().has_value());
  live_until(1080);
  EXPECT_NEAR(frame()->from_s, 1.0 - 0.025, 1e-9);
  EXPECT_EQ(trigger.stage, TriggerStage::kShown);
  live_until(1130);
  EXPECT_NEAR(frame()->from_s, 1.05 - 0.025, 1e-9);
}

TEST_F(TriggerTest, AutoFollowsTheNewestSamplesWhereNoContactComes) {
  settings.mode = TriggerMode::kAuto;
  touches = {{3000, 3050}, {9000, 9100}};
  live_until(2500);
  EXPECT_NEAR(frame()->to_s, history_.newest_time_s(), 1e-9);
  EXPECT_EQ(trigger.stage, TriggerStage::kWaiting);
  live_until(3100);
  EXPECT_NEAR(frame()->from_s, 2.75, 1e-9);
  live_until(4700);  // less than a second after the window's end
  EXPECT_NEAR(frame()->from_s, 2.75, 1e-9);
  live_until(6000);
  EXPECT_NEAR(frame()->to_s, history_.newest_time_s(), 1e-9);
  live_until(9100);
  EXPECT_NEAR(frame()->from_s, 8.75, 1e-9);
}

TEST_F(TriggerTest, SingleTakesTheNextContactAndNoOther) {
  settings.mode = TriggerMode::kSingle;
  touches = {{500, 600}, {2000, 2100}, {4000, 4100}};
  live_until(1000);
  trigger = armed_trigger(settings, history_.newest_time_s());
  EXPECT_FALSE(frame().has_value()) << "the contact before does not count";
  live_until(2500);
  EXPECT_NEAR(frame()->from_s, 1.75, 1e-9);
  live_until(2800);
  ASSERT_TRUE(frame().has_value());
  EXPECT_EQ(trigger.stage, TriggerStage::kDone);
  live_until(6000);
  EXPECT_NEAR(frame()->from_s, 1.75, 1e-9);
  trigger = armed_trigger(settings, history_.newest_time_s());
  EXPECT_FALSE(frame().has_value());
}

TEST_F(TriggerTest, NormalShowsAContactThatIsThereAlready) {
  touches = {{500, 600}};
  live_until(5000);
  trigger = armed_trigger(settings, history_.newest_time_s());
  EXPECT_NEAR(frame()->from_s, 0.25, 1e-9);
}

TEST_F(TriggerTest, AfterAResetItWaitsForANewContact) {
  touches = {{500, 600}};
  live_until(5000);
  ASSERT_TRUE(frame().has_value());
  next_ = 0;
  live_until(300);
  EXPECT_FALSE(frame().has_value());
  EXPECT_EQ(trigger.stage, TriggerStage::kWaiting);
  live_until(700);
  EXPECT_NEAR(frame()->from_s, 0.25, 1e-9);
}

TEST_F(TriggerTest, ShowsNothingWithoutSamples) { EXPECT_FALSE(frame().has_value()); }

TEST(NewestWindow, ASessionYoungerThanTheWindowBeginsAtTheLeft) {
  EXPECT_DOUBLE_EQ(newest_window(1.0, 4.0).from_s, 0.0);
  EXPECT_DOUBLE_EQ(newest_window(1.0, 4.0).to_s, 4.0);
  EXPECT_DOUBLE_EQ(newest_window(10.5, 4.0).from_s, 6.5);
}

}  // namespace
}  // namespace hapticwall::draw
