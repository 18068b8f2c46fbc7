#include "app/ui/wall/wall_renderer.h"

#include <gtest/gtest.h>

#include "app/ui/wall/wall_solids.h"
#include "tests/app/ui/pixels.h"
#include "tests/offscreen/offscreen.h"

namespace hapticwall::ui {
namespace {

constexpr int kPictureWidth = 800;
constexpr int kPictureHeight = 400;
constexpr AxisExtent kExtent{0.015, 0.08};
const WallSpace kLine{kExtent, std::nullopt};
const WallSpace kPlane{kExtent, kExtent};
constexpr double kStiff = 35000.0;

// Tests in the theme of the parameter.
class WallRendererTest : public ::testing::TestWithParam<draw::Look> {
 protected:
  void SetUp() override {
    auto context = test::OffscreenContext::create();
    ASSERT_TRUE(context.ok()) << context.error().message;
    context_ = std::move(*context);
    auto renderer = WallRenderer::create();
    ASSERT_TRUE(renderer.ok()) << renderer.error().message;
    renderer_ = std::move(*renderer);
    theme_.colours = theme_colours(GetParam());
  }
  void TearDown() override { renderer_.reset(); }

  void look_from(const WallSpace& space, const WallOrbit& orbit) {
    camera_ = WallCamera(space, orbit, kPictureWidth, kPictureHeight);
  }
  GLuint draw_once(const WallPicture& picture) {
    return renderer_->draw(picture, camera_, theme_, kPictureWidth, kPictureHeight);
  }
  file::Picture draw(const WallPicture& picture) {
    EXPECT_NE(draw_once(picture), 0U);
    return draw::read_pixels(renderer_->framebuffer(), kPictureWidth, kPictureHeight);
  }
  [[nodiscard]] test::Colour at(const file::Picture& picture, glm::vec3 point) const {
    const glm::vec2 pixel = camera_.pixel_of(point);
    return test::pixel(picture, static_cast<int>(pixel.x), static_cast<int>(pixel.y));
  }
  // Difference of the picture at this place.
  [[nodiscard]] int change(const file::Picture& a, const file::Picture& b, glm::vec3 point) const {
    return test::difference(at(a, point), at(b, point));
  }
  [[nodiscard]] test::Colour tone(draw::Tone value) const {
    return test::colour_of(theme_.colour(value));
  }
  [[nodiscard]] glm::vec3 ball(double position_m) const {
    return ball_centre(false, camera_, {position_m, 0.0});
  }
  [[nodiscard]] glm::vec3 on_face(double face_m, float up, float aside) const {
    return {camera_.x_of(face_m), up, aside};
  }

  std::unique_ptr<test::OffscreenContext> context_;
  std::unique_ptr<WallRenderer> renderer_;
  draw::Theme theme_;
  WallCamera camera_{kLine, {}, kPictureWidth, kPictureHeight};
};

WallPicture one_wall(double stiffness_n_per_m = kStiff) {
  WallPicture picture;
  picture.handle_m = {0.03, 0.0};
  picture.full_scale_n = 8.0;
  picture.walls = {{Axis::kX, 0.05, stiffness_n_per_m}};
  return picture;
}

TEST_P(WallRendererTest, TheHandleIsWhereItsPositionSays) {
  WallPicture picture;
  picture.handle_m = {0.04, 0.0};
  const file::Picture here = draw(picture);
  picture.handle_m = {0.07, 0.0};
  const file::Picture away = draw(picture);
  EXPECT_GT(change(here, away, ball(0.04)), 60);
  EXPECT_GT(change(here, away, ball(0.07)), 60);
  const glm::vec3 floor(camera_.x_of(0.04), WallMeasures::kFloor, 2.5F);
  EXPECT_EQ(change(here, away, floor), 0);
}

TEST_P(WallRendererTest, TheHandleThrowsAShadowOnTheFloorBelowIt) {
  WallPicture picture;
  picture.handle_m = {0.04, 0.0};
  const glm::vec3 below(camera_.x_of(0.04) - 1.3F, WallMeasures::kFloor, -0.1F);
  const file::Picture with = draw(picture);
  picture.handle_m = {0.075, 0.0};
  EXPECT_GT(test::brightness(at(draw(picture), below)), test::brightness(at(with, below)) + 10);
}

TEST_P(WallRendererTest, TheWallStandsAtItsFaceAndNotBeforeIt) {
  WallPicture picture = one_wall();
  const file::Picture with = draw(picture);
  picture.walls.clear();
  const file::Picture without = draw(picture);
  const glm::vec3 inside(camera_.x_of(0.065), 0.6F, WallMeasures::kWallHalfDepth);
  EXPECT_GT(change(with, without, inside), 25);
  const test::Colour wall = at(with, inside);
  EXPECT_GT(wall.green, wall.red) << "a stiff wall has the wall's tone";
  const glm::vec3 before(camera_.x_of(0.032), 0.9F, WallMeasures::kWallHalfDepth);
  EXPECT_EQ(change(with, without, before), 0);
}

TEST_P(WallRendererTest, TheForceIsAnArrowOfItsLengthAndRedAtTheLimit) {
  WallPicture picture = one_wall();
  picture.walls.clear();
  picture.handle_m = {0.05, 0.0};
  const float tip = camera_.x_of(0.05);
  const glm::vec3 near_tip(tip - 0.3F, WallMeasures::kArrowHeight, 0.0F);
  const glm::vec3 far_away(tip - 0.8F * WallMeasures::kMaxArrow, WallMeasures::kArrowHeight, 0.0F);
  const file::Picture none = draw(picture);
  picture.force_n.x = 4.0;
  const file::Picture half = draw(picture);
  EXPECT_LT(test::difference(at(half, near_tip), tone(draw::Tone::kForce)), 70);
  EXPECT_GT(change(half, none, near_tip), 60);
  EXPECT_EQ(change(half, none, far_away), 0);
  picture.force_n.x = 8.0;
  picture.saturated = true;
  const file::Picture full = draw(picture);
  EXPECT_GT(change(full, none, far_away), 60);
  EXPECT_LT(test::difference(at(full, near_tip), tone(draw::Tone::kBad)), 70);
}

TEST_P(WallRendererTest, TheHandIsASleeveAndATipAlsoInsideTheWall) {
  WallPicture picture = one_wall();
  picture.handle_m = {0.04, 0.0};
  const file::Picture without = draw(picture);
  picture.hand_m = glm::dvec2(0.07, 0.0);
  const file::Picture with = draw(picture);
  const glm::vec3 sleeve(camera_.x_of(0.07) - 1.8F, 0.0F, 0.0F);
  EXPECT_GT(change(with, without, sleeve), 25);
  const test::Colour colour = at(with, sleeve);
  EXPECT_GT(colour.blue, colour.green) << "in the hand's tone";
}

TEST_P(WallRendererTest, TheHandleStaysAtTheFaceAndItsTruePlaceIsAnOutline) {
  WallPicture picture = one_wall(1000.0);
  picture.handle_m = {0.05, 0.0};
  const file::Picture touching = draw(picture);
  picture.handle_m = {0.06, 0.0};
  const file::Picture inside = draw(picture);
  const glm::vec3 rod = ball(0.05) + glm::vec3(-1.0F, 0.0F, 0.0F);
  EXPECT_EQ(change(touching, inside, rod), 0) << "the handle itself does not enter";
  const glm::vec3 outline = ball(0.06) + glm::vec3(0.0F, 0.96F * WallMeasures::kHandleRadius, 0.0F);
  const test::Colour accent = tone(draw::Tone::kAccent);
  EXPECT_LT(test::difference(at(inside, outline), accent) + 20,
            test::difference(at(touching, outline), accent));
}

TEST_P(WallRendererTest, AShakingHandleAndForceAreSweptOverTheirWay) {
  WallPicture picture = one_wall();
  picture.handle_m = {0.04, 0.0};
  picture.force_n.x = 4.0;
  const file::Picture still = draw(picture);
  picture.handle_reach_m = {{0.0, 0.0}, {0.008, 0.0}};
  picture.force_reach_n = {{0.0, 0.0}, {4.0, 0.0}};
  const file::Picture shakes = draw(picture);
  EXPECT_GT(change(still, shakes, ball(0.046)), 25);
  EXPECT_EQ(change(still, shakes, ball(0.04) - glm::vec3(1.5F, 0.0F, 0.0F)), 0) << "the rod";
  const glm::vec3 most(camera_.x_of(0.048) - 0.8F * WallMeasures::kMaxArrow,
                       WallMeasures::kArrowHeight, 0.0F);
  EXPECT_GT(change(still, shakes, most), 25);
}

TEST_P(WallRendererTest, TheEdgesHaveTheLampsColour) {
  WallPicture picture = one_wall();
  picture.handle_m = {0.02, 0.0};
  const glm::vec3 edge = on_face(0.05, 0.4F, WallMeasures::kWallHalfDepth);
  picture.verdict = draw::Tone::kBad;
  const test::Colour bad = at(draw(picture), edge);
  picture.verdict = draw::Tone::kGood;
  const test::Colour good = at(draw(picture), edge);
  EXPECT_GT(bad.red, bad.green);
  EXPECT_GT(good.green, good.red);
}

TEST_P(WallRendererTest, TheWallShowsTheStiffnessItDisplays) {
  WallPicture picture = one_wall();
  picture.handle_m = {0.0501, 0.0};
  const glm::vec3 beside = on_face(0.05, -0.7F, 0.7F);
  const auto colour = [&](double n_per_m, double strength) {
    picture.shown.front() = {n_per_m, strength};
    return at(draw(picture), beside);
  };
  const test::Colour stiff = colour(kStiff, 1.0);
  const test::Colour soft = colour(3500.0, 1.0);
  const test::Colour softest = colour(10.0, 1.0);
  EXPECT_GT(test::difference(stiff, soft), 20);
  EXPECT_GT(test::difference(soft, softest), 20);
  EXPECT_LT(test::difference(colour(1e9, 1.0), stiff), 4) << "capped at the wall's own";
  EXPECT_EQ(test::difference(colour(10.0, 0.0), colour(kStiff, 0.0)), 0) << "nothing is displayed";
  EXPECT_GT(test::difference(colour(10.0, 0.0), softest), 20);
}

TEST_P(WallRendererTest, EveryLayerIsSeenInItsOwnTint) {
  WallPicture picture = one_wall();
  picture.walls = {{Axis::kX, 0.045, 350.0}, {Axis::kX, 0.055, 3500.0}, {Axis::kX, 0.065, kStiff}};
  const file::Picture layers = draw(picture);
  const auto side = [&](double position_m) {
    return at(layers, {camera_.x_of(position_m), 0.6F, WallMeasures::kWallHalfDepth});
  };
  EXPECT_GT(test::difference(side(0.050), side(0.060)), 10);
  EXPECT_GT(test::difference(side(0.060), side(0.072)), 10);
  // The edges of every face are there.
  picture.walls.clear();
  const file::Picture none = draw(picture);
  for (const double face_m : {0.045, 0.055, 0.065})
    EXPECT_GT(change(layers, none, on_face(face_m, 0.4F, WallMeasures::kWallHalfDepth)), 12);
}

TEST_P(WallRendererTest, ACornerHasAWallOnEitherAxisAndAHandleThatTouchesBoth) {
  look_from(kPlane, {});
  WallPicture picture;
  picture.two_axes = true;
  picture.handle_m = {0.03, 0.03};
  const file::Picture none = draw(picture);
  const float middle = 0.5F * (WallMeasures::kFloor + WallMeasures::kCornerTop);
  const glm::vec3 right(camera_.x_of(0.05), middle, camera_.z_of(0.02));
  const glm::vec3 back(camera_.x_of(0.025), middle, camera_.z_of(0.05));
  picture.walls = {{Axis::kX, 0.05, kStiff}};
  const file::Picture only_x = draw(picture);
  EXPECT_GT(change(only_x, none, right), 20);
  EXPECT_EQ(change(only_x, none, back), 0);
  picture.walls.push_back({Axis::kY, 0.05, 1000.0});
  const file::Picture both = draw(picture);
  EXPECT_GT(change(both, none, back), 20);
  // In the corner the ball touches both faces and is in neither.
  const glm::vec3 ball_there = ball_centre(true, camera_, {0.05, 0.05});
  EXPECT_FLOAT_EQ(ball_there.x + WallMeasures::kHandleRadius, camera_.x_of(0.05));
  EXPECT_FLOAT_EQ(ball_there.z - WallMeasures::kHandleRadius, camera_.z_of(0.05));
  const file::Picture apart = draw(picture);
  picture.handle_m = {0.05, 0.05};
  // Beside the handle's rod, which hides the middle.
  EXPECT_GT(change(draw(picture), apart, ball_there + glm::vec3(-0.3F, -0.1F, 0.1F)), 40);
}

TEST_P(WallRendererTest, AForceOnTwoAxesPointsWhereItPushes) {
  look_from(kPlane, {});
  WallPicture picture;
  picture.two_axes = true;
  picture.handle_m = {0.05, 0.05};
  picture.full_scale_n = 5.0;
  const file::Picture none = draw(picture);
  picture.force_n = {0.0, 5.0};
  const file::Picture out_of_second_wall = draw(picture);
  const glm::vec3 ball = ball_centre(true, camera_, picture.handle_m);
  EXPECT_GT(change(out_of_second_wall, none, ball + glm::vec3(0.0F, 0.0F, 2.0F)), 60)
      << "towards the viewer";
  EXPECT_EQ(change(out_of_second_wall, none, ball - glm::vec3(2.0F, 0.0F, 0.0F)), 0);
}

TEST_P(WallRendererTest, TheCameraTurnsTheWholePicture) {
  WallPicture picture = one_wall();
  picture.handle_m = {0.04, 0.0};
  for (const double yaw : {-40.0, 0.0, 60.0}) {
    for (const double zoom : {0.8, 1.0, 3.0}) {
      look_from(kLine, {glm::radians(yaw), glm::radians(25.0), zoom, {}});
      picture.handle_m = {0.04, 0.0};
      const file::Picture here = draw(picture);
      picture.handle_m = {0.02, 0.0};
      const file::Picture away = draw(picture);
      const glm::vec2 pixel = camera_.pixel_of(ball(0.04));
      if (pixel.x < 0.0F || pixel.x >= kPictureWidth || pixel.y < 0.0F || pixel.y >= kPictureHeight)
        continue;
      EXPECT_GT(change(here, away, ball(0.04)), 30) << yaw << " " << zoom;
    }
  }
}

TEST_P(WallRendererTest, OnlyWhatLooksDifferentIsDrawnAgain) {
  WallPicture picture = one_wall();
  draw_once(picture);
  const std::uint64_t before = renderer_->times_drawn();
  picture.handle_m.x += 1e-8;
  draw_once(picture);
  EXPECT_EQ(renderer_->times_drawn(), before);
  picture.handle_m.x += 1e-3;
  draw_once(picture);
  EXPECT_EQ(renderer_->times_drawn(), before + 1);
  look_from(kLine, {0.1, 0.0, 1.0, {}});
  draw_once(picture);
  EXPECT_EQ(renderer_->times_drawn(), before + 2);
  theme_.colours =
      theme_colours(GetParam() == draw::Look::kLight ? draw::Look::kScreen : draw::Look::kLight);
  draw_once(picture);
  EXPECT_EQ(renderer_->times_drawn(), before + 3);
  renderer_->draw(picture, camera_, theme_, kPictureWidth, kPictureHeight + 1);
  EXPECT_EQ(renderer_->times_drawn(), before + 4);
}

TEST_P(WallRendererTest, APictureThatStaysIsRefinedOnceAndLooksTheSame) {
  const WallPicture picture = one_wall();
  const file::Picture first = draw(picture);
  constexpr int kEnoughCalls = 60;
  for (int i = 0; i < kEnoughCalls; ++i) draw_once(picture);
  EXPECT_TRUE(renderer_->refined());
  EXPECT_LE(renderer_->times_drawn(), 2U);
  const file::Picture last = draw(picture);
  int different = 0;
  for (int y = 0; y < kPictureHeight; ++y) {
    for (int x = 0; x < kPictureWidth; ++x)
      if (test::difference(test::pixel(first, x, y), test::pixel(last, x, y)) > 24) ++different;
  }
  EXPECT_LT(different, kPictureWidth * kPictureHeight / 50) << "only along edges";
}

TEST_P(WallRendererTest, AnyWindowSizeWorks) {
  for (const int size : {1, 3, 2000}) {
    const WallCamera camera(kLine, {}, static_cast<float>(size), 7.0F);
    EXPECT_NE(renderer_->draw({}, camera, theme_, size, 7), 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Looks, WallRendererTest,
                         ::testing::Values(draw::Look::kScreen, draw::Look::kLight),
                         [](const auto& look) {
                           return look.param == draw::Look::kScreen ? "Dark" : "Light";
                         });

}  // namespace
}  // namespace hapticwall::ui
