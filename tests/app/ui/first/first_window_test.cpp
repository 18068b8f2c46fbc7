// The window as it opens: two walls side by side under one hand.
#include "app/ui/first/first_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/ui/panel/verdict_view.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class FirstWindowTest : public GuiTest {
 protected:
  FirstWindowTest() { shows_everything = false; }

  void SetUp() override {
    GuiTest::SetUp();
    press(ImGuiKey_1);
    reset();
  }
  void reset() {
    click("reset");
    frames(2);
  }
  [[nodiscard]] const ui::OtherWall& other() const { return state().first.other; }
  [[nodiscard]] std::string algorithm_of(const Scene& scene) const {
    return std::string(algorithms()[scene.algorithm.index].name);
  }
};

TEST_F(FirstWindowTest, OneWallShakesAndTheOtherIsStill) {
  live(5000);
  EXPECT_EQ(algorithm_of(scene()), "none");
  EXPECT_EQ(algorithm_of(other().scene()), "energy-bounding");
  const std::string shown = text();
  EXPECT_THAT(shown, HasSubstr("oscillating"));
  EXPECT_THAT(shown, HasSubstr("2.8 mm at 50 Hz"));
  EXPECT_THAT(shown, HasSubstr("settled"));
  EXPECT_THAT(shown, HasSubstr("30 kN/m"));
  EXPECT_THAT(shown, HasSubstr("The hold has fed the hand"));
  EXPECT_THAT(shown, Not(HasSubstr("Eq."))) << "newcomers know no equations";
  EXPECT_EQ(draw::tail_tone(state().tails.front()), draw::Tone::kBad);
  EXPECT_EQ(draw::tail_tone(other().tail()), draw::Tone::kGood);
  EXPECT_NEAR(state().time.to_s - state().time.from_s, 0.2, 1e-9) << "ten periods";
}

TEST_F(FirstWindowTest, TheOtherWallHasTheTicksOfTheSession) {
  live(3000);
  EXPECT_EQ(other().newest().tick, newest().tick);
  reset();
  live(200);
  EXPECT_EQ(other().newest().tick, newest().tick);
  EXPECT_EQ(other().history().size(), application_->history().size());
}

TEST_F(FirstWindowTest, AClickOnTheOtherWallMakesItTheSession) {
  live(3000);
  const int before = sessions;
  click("lead B");
  live(3000);
  EXPECT_EQ(sessions, before) << "the session goes on";
  EXPECT_EQ(algorithm_of(scene()), "energy-bounding");
  EXPECT_EQ(algorithm_of(other().scene()), "none");
  EXPECT_TRUE(sees("lead A"));
  EXPECT_FALSE(sees("lead B"));
  EXPECT_EQ(draw::tail_tone(other().tail()), draw::Tone::kBad);
}

TEST_F(FirstWindowTest, ADragInThePictureLeadsBothHands) {
  live(1000);
  const double hand_m = newest().truth.hand_path_m;
  drag_by("wall view", ImVec2(-60.0F, 0.0F));
  EXPECT_TRUE(state().hand.led);
  live(1500);
  EXPECT_LT(newest().truth.hand_path_m, hand_m);
  EXPECT_EQ(other().newest().truth.hand_path_m, newest().truth.hand_path_m);
}

TEST_F(FirstWindowTest, AChipChoosesTheAlgorithmOfTheLeadingWall) {
  click("virtual-coupling");
  live(100);
  EXPECT_EQ(algorithm_of(scene()), "virtual-coupling");
  EXPECT_EQ(algorithm_of(other().scene()), "energy-bounding");
}

TEST_F(FirstWindowTest, TwoWallsNeverHaveOneAlgorithm) {
  press(ImGuiKey_4);
  live(100);
  EXPECT_EQ(algorithm_of(scene()), "energy-bounding");
  EXPECT_EQ(algorithm_of(other().scene()), "none");
}

TEST_F(FirstWindowTest, MoreAndLessStandAtTheSamePlace) {
  live(100);
  const ItemRect more = rect("more");
  click("more");
  EXPECT_TRUE(state().window.more);
  const ItemRect less = rect("less");
  EXPECT_NEAR(less.centre().y, more.centre().y, 12.0F);
  EXPECT_NEAR(less.centre().x, more.centre().x, 80.0F);
  click("less");
  EXPECT_TRUE(sees("lead B"));
}

TEST_F(FirstWindowTest, EverythingIsInsideAndPlotsHaveRoomAtEverySizeAndScale) {
  struct Case {
    float width, height, scale;
  };
  live(3000);
  for (const Case& each : {Case{1280, 800, 1}, Case{1600, 1000, 1}, Case{1920, 1080, 1},
                           Case{1024, 680, 1}, Case{1280, 800, 2}, Case{1024, 680, 2}}) {
    SCOPED_TRACE(fmt::format("{}x{} at {}", each.width, each.height, each.scale));
    ImGui::GetIO().DisplaySize = ImVec2(each.width, each.height);
    application_->set_screen_scale(each.scale);
    frames(4);
    for (const char* name :
         {"pause", "reset", "begin tour", "more", "help", "wall view", "lead B", "none",
          "energy-limited-spring", "status", "runs Position", "runs Force"}) {
      const ItemRect item = rect(name);
      EXPECT_GE(item.from.x, 0.0F) << name;
      EXPECT_GE(item.from.y, 0.0F) << name;
      EXPECT_LE(item.to.x, each.width) << name;
      EXPECT_LE(item.to.y, each.height) << name;
    }
    for (const char* name : {"runs Position", "runs Force"})
      EXPECT_GE(rect(name).to.y - rect(name).from.y, 90.0F) << name;
    EXPECT_LE(rect("none").to.x, rect("virtual-coupling").from.x) << "chips do not overlap";
    EXPECT_GE(rect("none").from.y, rect("runs Position").to.y);
    EXPECT_LE(rect("wall view").to.y, rect("runs Position").from.y);
  }
}

TEST_F(FirstWindowTest, ADeviceHasOneWallAndTheUsualPages) {
  with_device = true;
  open("press");
  EXPECT_FALSE(sees("lead B"));
  EXPECT_TRUE(sees("wall view"));
  EXPECT_TRUE(sees("more"));
}

// Under none on a wall of 1e9 N/m without a force limit the handle flies out of reach.
TEST_F(FirstWindowTest, AnotherWallThatDivergesSaysSo) {
  press(ImGuiKey_4);
  Scene wild = scene();
  wild.x().walls.front().stiffness_n_per_m = 1e9;
  wild.x().device.force_limit_n.reset();
  ASSERT_FALSE(fake_->change_scene(wild));
  live(3000);
  EXPECT_EQ(algorithm_of(other().scene()), "none");
  EXPECT_LT(other().newest().tick, newest().tick);
  EXPECT_EQ(other().tail().summary.verdict, Verdict::kDiverged);
  EXPECT_THAT(text(), HasSubstr("diverged"));
}

// The energy that none has fed the hand is no debt of the algorithm that comes after it.
TEST_F(FirstWindowTest, TheStoryOfTheOtherWallBeginsAnewWithItsAlgorithm) {
  press(ImGuiKey_4);  // the other wall takes none
  live(3000);
  const double fed_j = other().story().extracted_j;
  EXPECT_GT(fed_j, 0.1);
  press(ImGuiKey_1);  // the two swap
  live(5);
  EXPECT_EQ(algorithm_of(other().scene()), "energy-bounding");
  EXPECT_LT(other().story().extracted_j, 0.1 * fed_j);
}

}  // namespace
}  // namespace hapticwall::test
