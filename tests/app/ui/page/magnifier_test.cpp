#include "app/ui/page/magnifier.h"

#include <gtest/gtest.h>

#include "app/draw/wall/wall_strip.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using draw::Axis;
using draw::Strip;
using draw::WallPicture;
using ui::Magnified;

constexpr double kUnmagnifiedM = 0.035;  // width of 300 pixels in a view with 8.6 pixels/mm

TEST(Magnification, IsTheLargestThatShowsTheDepthAndDoesNotFlicker) {
  EXPECT_EQ(ui::suitable_magnification(1e-6, kUnmagnifiedM, 0), 1000);
  EXPECT_EQ(ui::suitable_magnification(0.2e-3, kUnmagnifiedM, 0), 100);
  EXPECT_EQ(ui::suitable_magnification(1.0, kUnmagnifiedM, 0), 1) << "the smallest there is";
  // Near the limit of a larger magnification, the present one stays.
  const double limit_m = 0.65 * kUnmagnifiedM / 100.0;
  EXPECT_EQ(ui::suitable_magnification(0.95 * limit_m, kUnmagnifiedM, 0), 100);
  EXPECT_EQ(ui::suitable_magnification(0.95 * limit_m, kUnmagnifiedM, 100), 100);
  EXPECT_EQ(ui::suitable_magnification(0.95 * limit_m, kUnmagnifiedM, 50), 50);
  EXPECT_EQ(ui::suitable_magnification(0.70 * limit_m, kUnmagnifiedM, 50), 100);
}

TEST(Magnification, GoesStepByStepAndEnds) {
  EXPECT_EQ(ui::next_magnification(50, 1), 100);
  EXPECT_EQ(ui::next_magnification(50, -1), 20);
  EXPECT_EQ(ui::next_magnification(1000, 1), 1000);
  EXPECT_EQ(ui::next_magnification(1, -1), 1);
  EXPECT_EQ(ui::next_magnification(73, 0), 50) << "a value from a file becomes one of the list";
  EXPECT_EQ(ui::next_magnification(-4, 0), 1);
}

WallPicture picture_at(double tip_m) {
  WallPicture picture;
  picture.walls = {{Axis::kX, 0.05, 500.0}, {Axis::kX, 0.056, 35000.0}};
  picture.handle_m = {tip_m, 0.0};
  return picture;
}

TEST(LookAtContact, StaysAtTheFaceWhileTheHandleIsSeenThere) {
  for (const double tip_m : {0.03, 0.0499, 0.0503}) {
    const Magnified look = ui::look_at_contact(picture_at(tip_m), tip_m, tip_m, 1e-3, {0.05, 0.0});
    EXPECT_EQ(look.face_m, 0.05);
    EXPECT_NEAR(look.middle_m, 0.05 + 0.15e-3, 1e-9);
  }
}

TEST(LookAtContact, FollowsAHandleThatRestsDeeper) {
  const Magnified look =
      ui::look_at_contact(picture_at(0.0520), 0.05195, 0.0520, 1e-3, {0.05, 0.0});
  EXPECT_EQ(look.face_m, 0.05);
  EXPECT_NEAR(look.middle_m, 0.051975, 1e-9);
  const Magnified next = ui::look_at_contact(picture_at(0.0521), 0.0520, 0.0521, 1e-3, look);
  EXPECT_EQ(next.middle_m, look.middle_m) << "does not move while the handle is within";
  const Magnified swinging =
      ui::look_at_contact(picture_at(0.0521), 0.050, 0.0525, 1e-3, {0.05, 0.0});
  EXPECT_NEAR(swinging.middle_m, 0.05 + 0.15e-3, 1e-9)
      << "the view does not follow a swinging handle";
}

TEST(LookAtContact, ChangesToADeeperFaceWhenThatIsMuchNearer) {
  EXPECT_EQ(ui::look_at_contact(picture_at(0.0535), 0.0535, 0.0535, 1e-3, {0.05, 0.0}).face_m,
            0.05);
  EXPECT_EQ(ui::look_at_contact(picture_at(0.0555), 0.0555, 0.0555, 1e-3, {0.05, 0.0}).face_m,
            0.056);
  EXPECT_EQ(ui::look_at_contact(picture_at(0.0535), 0.0535, 0.0535, 1e-3, {0.056, 0.0}).face_m,
            0.056)
      << "hysteresis";
  EXPECT_EQ(ui::look_at_contact(picture_at(0.0535), 0.0535, 0.0535, 1e-3, {0.9, 0.0}).face_m, 0.056)
      << "the previous face is gone";
}

TEST(ScaleBar, IsRoundAndFits) {
  EXPECT_NEAR(draw::scale_bar_m(8.6e4, 110.0), 1e-3, 1e-12);
  EXPECT_NEAR(draw::scale_bar_m(8.6e5, 110.0), 1e-4, 1e-12);
  EXPECT_NEAR(draw::scale_bar_m(8.6e6, 50.0), 5e-6, 1e-12);
  EXPECT_EQ(draw::length_text(1e-3), "1 mm");
  EXPECT_EQ(draw::length_text(1e-4), "0.1 mm");
  EXPECT_EQ(draw::length_text(5e-6), "5 µm");
}

TEST(StripScale, IsTrueToScale) {
  const Strip strip{ImVec2(100.0F, 0.0F), ImVec2(400.0F, 200.0F), 0.05, 1e-3};
  EXPECT_FLOAT_EQ(strip.x_of(0.05), 250.0F);
  EXPECT_NEAR(strip.x_of(0.0501), 280.0F, 1e-2);
  EXPECT_TRUE(strip.shows(0.0504));
  EXPECT_FALSE(strip.shows(0.0506));
  EXPECT_LT(strip.x_of(1e9), 1e5F) << "safe to draw";
}

class MagnifierTest : public GuiTest {
 protected:
  [[nodiscard]] int magnification() const { return state().wall.transient.magnification; }
  [[nodiscard]] int chosen() const { return state().wall.persisted.magnification; }
  // Strip as placed by draw_magnifier().
  [[nodiscard]] Strip strip() const {
    const ItemRect area = rect("magnifier");
    const ItemRect view = rect("wall view");
    const ui::WallCamera camera(ui::wall_space(scene()), {}, view.to.x - view.from.x,
                                view.to.y - view.from.y);
    const double face_m = wall().position_m;
    const double pixels_per_m = 1e3 * static_cast<double>(glm::distance(
                                          camera.pixel_of(camera.point_of({face_m, 0.0})),
                                          camera.pixel_of(camera.point_of({face_m + 1e-3, 0.0}))));
    return {area.from, area.to, state().wall.transient.magnified.middle_m,
            static_cast<double>(area.to.x - area.from.x) / pixels_per_m / magnification()};
  }
};

TEST_F(MagnifierTest, ChoosesByItselfUntilSomebodyDoes) {
  live(3000);
  EXPECT_EQ(chosen(), 0);
  const int automatic = magnification();
  EXPECT_GT(automatic, 10);
  EXPECT_FALSE(sees("magnify automatically"));
  click("magnify less");
  EXPECT_EQ(magnification(), ui::next_magnification(automatic, -1));
  click("magnify more");
  click("magnify more");
  EXPECT_EQ(magnification(), ui::next_magnification(automatic, 1));
  click("magnify automatically");
  EXPECT_EQ(chosen(), 0);
  EXPECT_EQ(magnification(), automatic);
}

TEST_F(MagnifierTest, ShowsWhereHandleAndMeasurementAre) {
  press(ImGuiKey_3);
  live(4000);
  move_away();
  const file::Picture picture = screen();
  const Strip now = strip();
  const Sample sample = newest();
  ASSERT_TRUE(now.shows(sample.truth.position_m));
  ASSERT_TRUE(now.shows(sample.position_m));
  const auto level = static_cast<int>(now.handle_level());
  const auto column = [&](double position_m) { return static_cast<int>(now.x_of(position_m)); };
  const int tip = column(sample.truth.position_m);
  // Inside the handle's end, and in the wall just beyond it. Its way since the last frame is faint.
  const double free_m =
      sample.truth.position_m - state().wall.transient.swept.front().place_m.minimum;
  const Colour handle = pixel(picture, column(sample.truth.position_m - free_m) - 12, level);
  const Colour beyond = pixel(picture, tip + 12, level);
  EXPECT_GT(difference(handle, beyond), 60);
  const float x = std::floor(now.x_of(sample.position_m));
  const float upper = std::floor(now.handle_level() - 0.16F * now.height());
  const ItemRect measured{ImVec2(x - 2.0F, upper - 8.0F), ImVec2(x + 3.0F, upper + 4.0F)};
  EXPECT_GT(count_tone(picture, draw::Tone::kPosition, measured, draw::Look::kScreen, 40), 4);
}

TEST_F(MagnifierTest, DrawsEveryCountOfTheEncoderWhereItIs) {
  live(4000);
  state().wall.persisted.magnification = 20;
  frames(3);
  move_away();
  const file::Picture picture = screen();
  const Strip now = strip();
  const double encoder_m = *scene().x().device.encoder_m;
  // Ticks at the lower edge stand out from between them.
  const int low = static_cast<int>(now.to.y) - 3;
  int counts = 0;
  int seen = 0;
  for (long count = 0; count < 1000; ++count) {
    const double position_m = static_cast<double>(count) * encoder_m;
    if (!now.shows(position_m) || !now.shows(position_m + encoder_m)) continue;
    ++counts;
    const int x = static_cast<int>(std::lround(now.x_of(position_m)));
    const int between = static_cast<int>(now.x_of(position_m - 0.2 * encoder_m));
    int most = 0;
    for (int i = -2; i <= 2; ++i)
      most = std::max(most, difference(pixel(picture, x + i, low), pixel(picture, between, low)));
    if (most > 25) ++seen;
  }
  EXPECT_GT(counts, 3);
  EXPECT_EQ(seen, counts);
}

TEST_F(MagnifierTest, EveryMagnificationIsDrawnAndASceneWithoutAWallToo) {
  live(3000);
  for (const int wanted : ui::kMagnifications) {
    state().wall.persisted.magnification = wanted;
    live(100);
    EXPECT_EQ(magnification(), wanted);
  }
  ASSERT_FALSE(fake_->set_walls({}).has_value());
  frames(2);
  EXPECT_FALSE(sees("magnifier"));
}

}  // namespace
}  // namespace hapticwall::test
