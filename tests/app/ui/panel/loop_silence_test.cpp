// A loop that does not answer is seen within 200 ms, and nothing else is taken for one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ui::LoopAnswer;

constexpr double kFrameS = 1.0 / 60.0;
constexpr const char* kSilent = "the loop has not answered for ";

class LoopSilenceTest : public GuiTest {
 protected:
  void SetUp() override {
    options.now_s = [this] { return now_s_; };
    GuiTest::SetUp();
  }
  std::string text_after_a_frame() {
    now_s_ += kFrameS;
    return text();
  }
  static std::size_t count(const std::string& text) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(kSilent, at)) != std::string::npos; ++at) ++found;
    return found;
  }

  double now_s_ = 100.0;
};

TEST_F(LoopSilenceTest, IsToldWithin200MsByLampAndStatusRowAndEndsWithTheSilence) {
  for (int frame = 0; frame < 60; ++frame) {
    fake_->advance(16);
    ASSERT_THAT(text_after_a_frame(), Not(HasSubstr(kSilent)));
  }
  const double stalled_s = now_s_;
  fake_->stalled = true;
  std::string shown;
  while (count(shown) == 0 && now_s_ < stalled_s + 1.0) shown = text_after_a_frame();
  EXPECT_GT(now_s_ - stalled_s, 0.1);
  EXPECT_LT(now_s_ - stalled_s, 0.2);
  EXPECT_GE(count(shown), 2U) << "lamp and status row";
  EXPECT_THAT(shown, Not(HasSubstr("driven by the test"))) << "the set-up is not praised beside it";
  EXPECT_TRUE(application_->moving()) << "or the next frame would come after a second";
  now_s_ = stalled_s + 8.0;
  EXPECT_THAT(text(), HasSubstr("has not answered for 8.0 s"));
  fake_->stalled = false;
  shown = text_after_a_frame();
  EXPECT_EQ(count(shown), 0U);
  EXPECT_THAT(shown, HasSubstr("driven by the test"));
}

TEST_F(LoopSilenceTest, APauseAndSlowMotionAreNone) {
  fake_->is_paused = true;
  for (int frame = 0; frame < 30; ++frame) EXPECT_EQ(count(text_after_a_frame()), 0U);
  fake_->is_paused = false;
  fake_->periods_per_tick = 1000;
  for (int frame = 0; frame < 30; ++frame) EXPECT_EQ(count(text_after_a_frame()), 0U);
}

// The loop went on meanwhile.
TEST_F(LoopSilenceTest, AFrameThatTakesLongIsNone) {
  now_s_ += 5.0;
  EXPECT_EQ(count(text()), 0U);
}

TEST_F(LoopSilenceTest, AnotherSessionBeginsAnew) {
  fake_->stalled = true;
  now_s_ += 1.0;
  EXPECT_GE(count(text()), 2U);
  open("tap");
  EXPECT_EQ(count(text_after_a_frame()), 0U);
}

TEST(LoopAnswerTest, ASlowLoopHasThreePeriods) {
  LoopAnswer answer;
  session::Snapshot snapshot;
  snapshot.cycles = 5;
  ui::note_answer(answer, &snapshot, 0.1, 1.0);
  ui::note_answer(answer, &snapshot, 0.1, 1.25);
  EXPECT_EQ(ui::silence_text(answer), "");
  ui::note_answer(answer, &snapshot, 0.1, 1.35);
  EXPECT_EQ(ui::silence_text(answer), "the loop has not answered for 0.4 s");
  ui::note_answer(answer, nullptr, 0.1, 2.0);
  EXPECT_EQ(ui::silence_text(answer), "") << "no loop runs";
}

}  // namespace
}  // namespace hapticwall::test
