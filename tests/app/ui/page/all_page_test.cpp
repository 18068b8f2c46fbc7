#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/draw/verdict/tail.h"
#include "app/ui/state/blind_test.h"
#include "core/run/simulate.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;

class AllPageTest : public GuiTest {
 protected:
  void SetUp() override {
    GuiTest::SetUp();
    click("page All at once");
    runs_are_there();
  }
  void runs_are_there() {
    frames_until([&] { return all().up_to_date(); });
    frames(2);
  }
  [[nodiscard]] ui::AllRuns& all() const { return state().all_runs; }
};

TEST_F(AllPageTest, ShowsTheVerdictOfEveryAlgorithmAndAClickPutsItInForce) {
  const std::size_t count = all().runs().size();
  const std::string first = "all " + all().runs().front().algorithm.label;
  for (std::size_t i = 0; i < count; ++i) {
    runs_are_there();  // a form of an algorithm stays chosen in the runs of the others
    const ui::AlgorithmRun run = all().runs()[i];
    const std::string item = "all " + run.algorithm.label;
    if (!sees(item)) scroll_down_at(first);
    click(item);
    EXPECT_EQ(scene().algorithm, run.algorithm.settings) << item;
    EXPECT_EQ(draw::figures_text(simulate(scene()).summary), draw::figures_text(run.summary));
    EXPECT_THAT(text(), HasSubstr("mm p-p")) << item;
  }
  EXPECT_EQ(sessions, 1) << "each changes while the session runs";
}

// tests/app/draw/figure/comparison_figure_test.cpp expects the same of a figure.
TEST_F(AllPageTest, AVerdictHasTheColourOfItsGrade) {
  constexpr int kBlurred = 60;  // thin strokes
  for (const ui::AlgorithmRun& run : all().runs()) {
    if (run.summary.verdict != Verdict::kOscillating) continue;
    const auto line = find_item(fmt::format("all {}", run.algorithm.label));
    if (!line) continue;
    const float height = line->to.y - line->from.y;
    const ItemRect below{ImVec2(line->from.x, line->to.y),
                         ImVec2(line->to.x, line->to.y + 2.0F * height)};
    const file::Picture picture = screen();
    const int bad = count_tone(picture, draw::verdict_tone(run.summary.verdict), below,
                               draw::Look::kScreen, kBlurred);
    EXPECT_GT(bad, 0);
    EXPECT_GT(bad, count_tone(picture, draw::Tone::kWarning, below, draw::Look::kScreen, kBlurred));
    return;
  }
  FAIL() << "no run of this scene oscillates in sight";
}

TEST_F(AllPageTest, FollowsTheScene) {
  const std::string before = draw::figures_text(all().runs().front().summary);
  Scene changed = scene();
  changed.x().walls.front().stiffness_n_per_m = 500.0;
  ASSERT_FALSE(fake_->change_scene(changed));
  frames(1);
  EXPECT_FALSE(all().up_to_date());
  runs_are_there();
  EXPECT_NE(draw::figures_text(all().runs().front().summary), before);
}

TEST_F(AllPageTest, AnotherPageAndABlindTestStopAndHideIt) {
  Scene endless = scene();
  endless.duration_s = 1e5;
  ASSERT_FALSE(fake_->change_scene(endless));
  frames(60);  // until the wall is refined
  ASSERT_TRUE(all().running());
  EXPECT_TRUE(application_->moving());
  click("page Blind test");
  EXPECT_FALSE(all().running());
  start_trials(4);
  ASSERT_TRUE(ui::blind_test_runs(state().compare));
  show_page(state().dock, "All at once");
  frames(3);
  EXPECT_FALSE(all().running());
  EXPECT_FALSE(sees("all none"));
}

TEST_F(AllPageTest, ADeviceHasNoRunsAndThePageSaysSo) {
  with_device = true;
  open("press");
  click("page All at once");
  frames(3);
  EXPECT_THAT(text(), HasSubstr("The hand at a device has no model"));
  EXPECT_FALSE(all().running());
}

}  // namespace
}  // namespace hapticwall::test
