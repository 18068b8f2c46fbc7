#include "app/ui/wall_renderer.h"

#include <gtest/gtest.h>

#include "app/ui/offscreen.h"
#include "tests/ui/pixels.h"

namespace hapticwall::ui {
namespace {

constexpr int kWidth = 800;
constexpr int kHeight = 400;
constexpr AxisExtent kExtent{0.015, 0.08};

class WallRendererTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = OffscreenContext::create();
    ASSERT_TRUE(context.ok()) << context.error().message;
    context_ = std::move(*context);
    auto renderer = WallRenderer::create();
    ASSERT_TRUE(renderer.ok()) << renderer.error().message;
    renderer_ = std::move(*renderer);
    theme_.colours = theme_colours(Look::kScreen);
  }
  void TearDown() override { renderer_.reset(); }

  file::Picture draw(const WallPicture& picture) {
    EXPECT_NE(renderer_->draw(picture, camera_, theme_, kWidth, kHeight), 0U);
    return read_pixels(renderer_->framebuffer(), kWidth, kHeight);
  }
  [[nodiscard]] test::Colour at(const file::Picture& picture, glm::vec3 point) const {
    const glm::vec2 pixel = camera_.pixel_of(point);
    return test::pixel(picture, static_cast<int>(pixel.x), static_cast<int>(pixel.y));
  }
  [[nodiscard]] test::Colour tone(Tone value) const {
    return test::colour_of(theme_.colour(value));
  }

  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<WallRenderer> renderer_;
  Theme theme_;
  WallCamera camera_{kExtent, kWidth, kHeight};
};

TEST_F(WallRendererTest, TheHandleIsWhereItsPositionSays) {
  WallPicture picture;
  picture.handle_m = 0.04;
  const glm::vec3 ball(camera_.x_of(0.04) - WallMeasures::kHandleRadius, 0.0F, 0.0F);
  const file::Picture here = draw(picture);
  EXPECT_GT(test::brightness(at(here, ball)), 120);
  picture.handle_m = 0.07;
  const file::Picture away = draw(picture);
  EXPECT_LT(test::brightness(at(away, ball + glm::vec3(0.0F, 0.2F, 0.0F))), 90);
  EXPECT_GT(
      test::brightness(at(away, {camera_.x_of(0.07) - WallMeasures::kHandleRadius, 0.0F, 0.0F})),
      120);
}

TEST_F(WallRendererTest, TheWallStandsAtItsFaceAndNotBeforeIt) {
  WallPicture picture;
  picture.handle_m = 0.03;
  const file::Picture without = draw(picture);
  picture.wall_faces_m = {0.05};
  const file::Picture with = draw(picture);
  const glm::vec3 inside(camera_.x_of(0.065), 0.6F, WallMeasures::kWallHalfDepth);
  const test::Colour wall = at(with, inside);
  EXPECT_GT(test::difference(wall, at(without, inside)), 25);
  EXPECT_GT(wall.green, wall.red);
  const glm::vec3 before(camera_.x_of(0.032), 0.9F, WallMeasures::kWallHalfDepth);
  EXPECT_EQ(test::difference(at(with, before), at(without, before)), 0);
}

TEST_F(WallRendererTest, TheForceIsAnArrowOfItsLengthAndRedAtTheLimit) {
  WallPicture picture;
  picture.handle_m = 0.05;
  picture.full_scale_n = 8.0;
  const float tip = camera_.x_of(0.05);
  const glm::vec3 near_tip(tip - 0.3F, WallMeasures::kArrowHeight, 0.0F);
  const glm::vec3 far_away(tip - 0.8F * WallMeasures::kLongestArrow, WallMeasures::kArrowHeight,
                           0.0F);
  const file::Picture none = draw(picture);
  picture.force_n = 4.0;
  const file::Picture half = draw(picture);
  EXPECT_LT(test::difference(at(half, near_tip), tone(Tone::kForce)), 70);
  EXPECT_GT(test::difference(at(half, near_tip), at(none, near_tip)), 60);
  EXPECT_EQ(test::difference(at(half, far_away), at(none, far_away)), 0);
  picture.force_n = 8.0;
  picture.saturated = true;
  const file::Picture full = draw(picture);
  EXPECT_GT(test::difference(at(full, far_away), at(none, far_away)), 60);
  EXPECT_LT(test::difference(at(full, near_tip), tone(Tone::kBad)), 70);
}

TEST_F(WallRendererTest, TheHandsIntentionIsAGhostAlsoInsideTheWall) {
  WallPicture picture;
  picture.handle_m = 0.04;
  picture.wall_faces_m = {0.05};
  const file::Picture without = draw(picture);
  picture.hand_m = 0.072;
  const file::Picture with = draw(picture);
  const glm::vec3 ghost(camera_.x_of(0.072) - WallMeasures::kHandleRadius, 0.0F, 0.0F);
  EXPECT_GT(test::brightness(at(with, ghost)), test::brightness(at(without, ghost)) + 15);
}

TEST_F(WallRendererTest, ContactGlows) {
  WallPicture picture;
  picture.handle_m = 0.0501;
  picture.wall_faces_m = {0.05};
  const file::Picture apart = draw(picture);
  picture.in_contact = true;
  const file::Picture touching = draw(picture);
  const glm::vec3 beside(camera_.x_of(0.05), 0.0F, 0.7F);
  EXPECT_GT(at(touching, beside).red, at(apart, beside).red + 20);
}

TEST_F(WallRendererTest, AnyWindowSizeWorks) {
  for (const int size : {1, 3, 2000}) {
    EXPECT_NE(
        renderer_->draw({}, WallCamera(kExtent, static_cast<float>(size), 7.0F), theme_, size, 7),
        0U);
  }
}

}  // namespace
}  // namespace hapticwall::ui
