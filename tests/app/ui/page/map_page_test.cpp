#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/draw/figure/map_field.h"
#include "app/ui/state/blind_test.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;

constexpr int kUntilStill = 60;  // frames, until the wall is refined

class MapPageTest : public GuiTest {
 protected:
  void SetUp() override {
    GuiTest::SetUp();
    Scene brief = scene();
    brief.duration_s = 1.5;  // for a fast map
    ASSERT_FALSE(fake_->change_scene(brief));
    click("page Map");
    first_picture();
  }

  // The first stage is enough for all but the last digit.
  void first_picture() {
    frames_until([&] { return live().up_to_date(); });
    frames(2);
  }
  [[nodiscard]] ui::LiveMap& live() const { return state().map.live; }
  [[nodiscard]] const StabilityMap& map() const { return live().picture()->map(); }

  // Over the field of an algorithm, at these shares of its cells.
  ImVec2 at(float x_share, float y_share, int field = 0) {
    return rect("map cells " + std::to_string(field)).at(x_share, y_share);
  }
  [[nodiscard]] MapMetrics simulated() const { return map_metrics(simulate(scene()).summary); }
};

TEST_F(MapPageTest, AClickMakesItsCellTheRunningSceneToTheLastDigit) {
  const std::uint32_t before = fake_->generation();
  click_at(at(0.905F, 0.095F));
  EXPECT_GT(fake_->generation(), before);
  EXPECT_EQ(sessions, 1) << "it is felt at once";
  EXPECT_NE(wall().stiffness_n_per_m, 35000.0);
  // The wall is that of the pointed cell, or of the middle of its block.
  std::size_t cell = 0;
  while (cell < map().cell_count() && map().scene_at(cell) != scene()) ++cell;
  ASSERT_LT(cell, map().cell_count());
  EXPECT_NEAR(static_cast<double>(map().place(cell).x), 54.0, 4.0);
  EXPECT_NEAR(static_cast<double>(map().place(cell).y), 54.0, 4.0);
  EXPECT_EQ(live().picture()->source(cell), cell);
  EXPECT_EQ(live().picture()->figures()[cell], simulated());
}

TEST_F(MapPageTest, AClickIsOneStepOfUndo) {
  const Scene before = scene();
  click_at(at(0.9F, 0.1F));
  ASSERT_NE(scene(), before);
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(scene(), before);
}

TEST_F(MapPageTest, AClickDoesNotRestartTheMapAndASliderBesideItsAxesDoes) {
  click_at(at(0.6F, 0.4F));
  EXPECT_TRUE(live().up_to_date());
  Scene changed = scene();
  changed.x().device.mass_kg *= 2.0;
  ASSERT_FALSE(fake_->change_scene(changed));
  frames(1);
  EXPECT_FALSE(live().up_to_date());
  first_picture();
  EXPECT_EQ(map().scene.x().device.mass_kg, changed.x().device.mass_kg);
}

TEST_F(MapPageTest, ThePictureOfASceneBeforeCannotBeClicked) {
  Scene changed = scene();
  changed.duration_s = 1e4;  // never done
  ASSERT_FALSE(fake_->change_scene(changed));
  frames(2);
  ASSERT_FALSE(live().up_to_date());
  click_at(at(0.9F, 0.1F));
  EXPECT_EQ(scene(), changed);
}

TEST_F(MapPageTest, TheDotStandsAtTheRunningScene) {
  move_away();
  const auto dot_at = [&](float x_share, float y_share) {
    const ImVec2 pixel = at(x_share, y_share);
    const file::Picture picture = screen();
    return count_pixels(picture, {255, 255, 255}, static_cast<int>(pixel.x) - 5,
                        static_cast<int>(pixel.y) - 5, static_cast<int>(pixel.x) + 6,
                        static_cast<int>(pixel.y) + 6, 8);
  };
  // The values of the scene are in the middle of both axes.
  EXPECT_GT(dot_at(0.5F, 0.5F), 10);
  Scene moved = scene();
  moved.x().walls.front().stiffness_n_per_m = map().x.value(49);
  moved.x().device.damping_n_s_per_m = map().y.value(10);
  ASSERT_FALSE(fake_->change_scene(moved));
  frames(2);
  EXPECT_EQ(dot_at(0.5F, 0.5F), 0);
  EXPECT_GT(dot_at(49.5F / 60.0F, 1.0F - 10.5F / 60.0F), 10);
}

TEST_F(MapPageTest, TheCellsHaveTheColoursOfTheFigure) {
  move_away();
  const file::Picture picture = screen();
  const ItemRect cells = rect("map cells 0");
  for (const std::size_t x : {3U, 22U, 40U}) {
    for (const std::size_t y : {4U, 13U, 49U}) {
      const ImU32 colour = draw::colour_of(live().picture()->figures()[y * map().x.count + x]);
      const ImVec2 pixel = cells.at((static_cast<float>(x) + 0.5F) / 60.0F,
                                    1.0F - (static_cast<float>(y) + 0.5F) / 60.0F);
      const int same =
          count_pixels(picture, colour_of(ImGui::ColorConvertU32ToFloat4(colour)),
                       static_cast<int>(pixel.x) - 2, static_cast<int>(pixel.y) - 2,
                       static_cast<int>(pixel.x) + 3, static_cast<int>(pixel.y) + 3, 4);
      EXPECT_GT(same, 5) << x << ", " << y;
    }
  }
}

TEST_F(MapPageTest, HoveringTellsVerdictFiguresAndValues) {
  move_to(at(0.25F, 0.75F));
  frames(2);
  const std::string seen = text();
  const std::size_t cell = live().picture()->source(15 * map().x.count + 15);
  EXPECT_THAT(seen, HasSubstr(std::string(verdict_name(live().picture()->figures()[cell].verdict)) +
                              " · "));
  EXPECT_THAT(seen, HasSubstr("wall stiffness: "));
  EXPECT_THAT(seen, HasSubstr("click: this becomes the running scene"));
}

TEST_F(MapPageTest, UnderAllAlgorithmsAFieldEachWhoseClickPutsItsAlgorithmInForce) {
  state().map.choice.algorithms.clear();
  for (std::size_t i = 0; i < algorithms().size(); ++i)
    ui::choose_algorithm_in_map(state().map.choice, i, true);
  frames(1);
  first_picture();
  for (std::size_t i = 0; i < algorithms().size(); ++i)
    EXPECT_TRUE(sees("map cells " + std::to_string(i)));
  const int last = static_cast<int>(algorithms().size()) - 1;
  click_at(at(0.3F, 0.3F, last));
  EXPECT_EQ(scene().algorithm.index, algorithms().size() - 1);
  const std::size_t cells = map().x.count * map().y.count;
  const auto figures = live().picture()->figures().subspan(static_cast<std::size_t>(last) * cells);
  EXPECT_NE(std::ranges::find(figures, simulated()), figures.end());
}

TEST_F(MapPageTest, AnotherPageStopsIt) {
  Scene changed = scene();
  changed.duration_s = 1e4;
  ASSERT_FALSE(fake_->change_scene(changed));
  frames(kUntilStill);
  ASSERT_TRUE(live().running());
  EXPECT_TRUE(application_->moving()) << "a paused window takes the results";
  click("page Plots");
  EXPECT_FALSE(live().running());
  frames(kUntilStill);
  EXPECT_FALSE(application_->moving());
}

TEST_F(MapPageTest, AnAxisOfTheRateStartsANewSession) {
  ui::choose_number(state().map.choice.axes.front(), "sampling.rate_hz");
  frames(1);
  first_picture();
  click_at(at(0.2F, 0.5F));
  EXPECT_EQ(sessions, 2);
  EXPECT_LT(scene().sampling.rate_hz, 1000.0);
}

TEST_F(MapPageTest, TheSameNumberOnBothAxesSwapsThem) {
  click("map number 0");
  click("map choice 0 device.damping_n_s_per_m");
  frames(2);
  EXPECT_EQ(state().map.choice.axes.front().path, "device.damping_n_s_per_m");
  EXPECT_EQ(state().map.choice.axes.back().path, "wall.stiffness_n_per_m");
}

TEST_F(MapPageTest, ARangeIsTypedRefusedAndTakenBack) {
  type("map from 0", "1000");
  EXPECT_EQ(state().map.choice.axes.front().range->low, 1000.0);
  type("map from 0", "1e6");
  EXPECT_THAT(refusal()->why, HasSubstr("must be less"));
  EXPECT_GE(rect(refusal()->why).from.y, rect("map from 0").to.y) << "below its field";
  EXPECT_EQ(state().map.choice.axes.front().range->low, 1000.0);
  click("map around 0");
  EXPECT_EQ(state().map.choice.axes.front().range->low, 3500.0);
  EXPECT_FALSE(refusal());
}

TEST_F(MapPageTest, TheListsShowTheirWholeChoiceInANarrowColumn) {
  for (const float width : {1280.0F, 900.0F, 800.0F}) {
    ImGui::GetIO().DisplaySize.x = width;
    frames(3);
    const std::string shown = state().map.choice.axes.front().path;
    const ItemRect list = rect("map number 0");
    const float text = ImGui::CalcTextSize(shown.c_str()).x;
    EXPECT_GT(list.to.x - list.from.x, text + ImGui::GetFrameHeight()) << width;
  }
}

TEST_F(MapPageTest, ABlindTestHidesAndStopsIt) {
  Scene changed = scene();
  changed.duration_s = 1e4;
  ASSERT_FALSE(fake_->change_scene(changed));
  frames(2);
  ASSERT_TRUE(live().running());
  click("page Blind test");
  start_trials(4);
  EXPECT_TRUE(ui::blind_test_runs(state().compare));
  show_page(state().dock, "Map");
  frames(3);
  EXPECT_FALSE(sees("map cells 0"));
  EXPECT_FALSE(live().running());
}

TEST_F(MapPageTest, ADeviceHasNoMapAndThePageSaysSo) {
  with_device = true;
  open("press");
  click("page Map");
  frames(3);
  EXPECT_THAT(text(), HasSubstr("The hand at a device has no model"));
  EXPECT_FALSE(live().running());
}

TEST_F(MapPageTest, AHandThatThePointerLeadsHasNoMap) {
  Scene led = scene();
  led.x().hand->follows_mouse = true;
  led.x().hand->path = {};
  state().scene.wanted = ui::WantedScene{led};
  frames(3);
  EXPECT_THAT(text(), HasSubstr("The pointer leads the hand"));
}

}  // namespace
}  // namespace hapticwall::test
