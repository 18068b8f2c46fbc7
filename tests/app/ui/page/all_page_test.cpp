#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "app/draw/figure/comparison_figure.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/tail.h"
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
    EXPECT_EQ(ui::figures_text(simulate(scene()).summary), ui::figures_text(run.summary));
    EXPECT_THAT(text(), HasSubstr("mm p-p")) << item;
  }
  EXPECT_EQ(sessions, 1) << "each changes while the session runs";
}

// The tone of a verdict that most pixels of the area have.
draw::Tone tone_in(const file::Picture& picture, draw::Look look, const ItemRect& area) {
  const auto pixels = [&](draw::Tone tone) {
    const ImVec4& colour = draw::theme_colours(look)[static_cast<std::size_t>(tone)];
    return count_pixels(picture, colour_of(colour), static_cast<int>(area.from.x),
                        static_cast<int>(area.from.y), static_cast<int>(area.to.x),
                        static_cast<int>(area.to.y));
  };
  const draw::Tone tone =
      std::ranges::max({draw::Tone::kGood, draw::Tone::kWarning, draw::Tone::kBad}, {}, pixels);
  EXPECT_GT(pixels(tone), 0);
  return tone;
}

TEST_F(AllPageTest, AVerdictHasTheColourThatItHasInAFigure) {
  const draw::FigureSize size{1200, 700};
  const ItemRect heading{ImVec2(0.0F, 0.0F), ImVec2(1200.0F, 700.0F / 6.0F)};
  std::set<Verdict> seen;
  for (const ui::AlgorithmRun& run : all().runs()) {
    const auto line = find_item(fmt::format("{}…", ui::figures_text(run.summary).substr(0, 24)));
    if (!line || !seen.insert(run.summary.verdict).second) continue;
    const std::array shown{draw::ComparedRun{run.summary, draw::SampleHistory(1, std::nullopt)}};
    const auto figure = draw::draw_comparison(scene(), shown, size);
    ASSERT_TRUE(figure.ok()) << figure.error().message;
    EXPECT_EQ(tone_in(screen(), draw::Look::kScreen, *line),
              tone_in(*figure, draw::Look::kPrint, heading))
        << verdict_name(run.summary.verdict);
  }
  EXPECT_TRUE(seen.contains(Verdict::kOscillating));
  EXPECT_GE(seen.size(), 2U);
}

TEST_F(AllPageTest, FollowsTheScene) {
  const std::string before = ui::figures_text(all().runs().front().summary);
  Scene changed = scene();
  changed.x().walls.front().stiffness_n_per_m = 500.0;
  ASSERT_FALSE(fake_->change_scene(changed));
  frames(1);
  EXPECT_FALSE(all().up_to_date());
  runs_are_there();
  EXPECT_NE(ui::figures_text(all().runs().front().summary), before);
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
  ASSERT_TRUE(ui::blind_test_runs(state()));
  show_page(state(), "All at once");
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
