#include "app/draw/wall/wall_picture.h"

#include <gtest/gtest.h>

namespace hapticwall::draw {
namespace {

const PictureWall kWall{Axis::kX, 0.05, 35000.0};

TEST(WallPicture, ShowsSceneAndSample) {
  Scene scene;
  scene.x().device.force_limit_n = 8.9;
  scene.x().hand = HandSettings{};
  scene.x().walls = {{0.06, 2000.0, 0.0}, {0.05, 500.0, 0.0}};
  Sample sample;
  sample.position_m = 0.0508;
  sample.truth.position_m = 0.0507;
  sample.truth.hand_path_m = 0.07;
  sample.force_n = 3.0;
  sample.flags = kFlagInContact | kFlagForceLimit;
  const WallPicture picture = wall_picture(scene, sample);
  EXPECT_EQ(picture.handle_m, glm::dvec2(0.0507, 0.0)) << "the true position, not the measured one";
  EXPECT_EQ(picture.hand_m, glm::dvec2(0.07, 0.0));
  EXPECT_EQ(picture.walls,
            (std::vector<PictureWall>{{Axis::kX, 0.05, 500.0}, {Axis::kX, 0.06, 2000.0}}));
  EXPECT_EQ(picture.force_n, glm::dvec2(3.0, 0.0));
  EXPECT_EQ(picture.full_scale_n, 8.9);
  EXPECT_TRUE(picture.saturated);
}

TEST(WallPicture, TheProxyStaysAtTheFaces) {
  WallPicture picture;
  picture.walls = {kWall, {Axis::kX, 0.06, 100.0}, {Axis::kY, 0.02, 100.0}};
  picture.handle_m = {0.049, 0.01};
  EXPECT_FALSE(proxy_of(picture).has_value());
  picture.handle_m = {0.061, 0.01};
  EXPECT_NEAR(proxy_of(picture)->x, 0.05, 1e-12) << "the outermost face";
  EXPECT_NEAR(proxy_of(picture)->y, 0.01, 1e-12);
  picture.handle_m = {0.061, 0.025};
  EXPECT_NEAR(proxy_of(picture)->x, 0.05, 1e-12);
  EXPECT_NEAR(proxy_of(picture)->y, 0.02, 1e-12);
}

TEST(WallPicture, SweepsWhatWasSinceTheLastFrame) {
  SampleHistory history(kHistoryCapacity);
  Swept swept;
  note_swept(swept, history);
  EXPECT_EQ(swept.end_tick, 0U);
  const auto push = [&](std::uint64_t tick, double position_m, double force_n) {
    Sample sample;
    sample.tick = tick;
    sample.truth.position_m = position_m;
    sample.force_n = force_n;
    history.push(sample);
  };
  push(0, 0.04, 1.0);
  note_swept(swept, history);
  push(1, 0.052, -2.0);
  push(2, 0.049, 8.0);
  push(3, 0.050, 3.0);
  note_swept(swept, history);
  note_swept(swept, history);  // a frame without a new sample keeps what was
  WallPicture picture;
  picture.walls = {{Axis::kX, 0.051, 100.0}};
  picture.handle_m.x = 0.05;
  picture.force_n.x = 3.0;
  sweep(picture, Axis::kX, swept);
  EXPECT_NEAR(swept_place(picture).from_m.x, 0.049, 1e-12);
  EXPECT_NEAR(swept_place(picture).to_m.x, 0.051, 1e-12) << "never in the wall";
  EXPECT_NEAR(deepest_place(picture)->x, 0.052, 1e-12);
  EXPECT_EQ(swept_force(picture).least_n.x, 0.0) << "it went through zero";
  EXPECT_NEAR(swept_force(picture).most_n.x, 8.0, 1e-12);
  push(0, 0.03, 0.0);  // a reset
  note_swept(swept, history);
  EXPECT_EQ(swept.place_m.minimum, 0.03);
  EXPECT_EQ(swept.place_m.maximum, 0.03);
}

TEST(StiffnessScale, IsLogarithmicAndEndsAtTheStiffestWallsOwn) {
  WallPicture picture;
  picture.walls = {kWall, {Axis::kX, 0.06, 500.0}};
  const StiffnessScale scale = stiffness_scale(picture);
  EXPECT_EQ(scale.share(35000.0), 1.0F);
  EXPECT_EQ(scale.share(1e9), 1.0F);
  EXPECT_NEAR(scale.share(3500.0), 0.5F, 1e-6);
  EXPECT_EQ(scale.share(350.0), 0.0F);
  EXPECT_EQ(scale.share(0.0), 0.0F);
  EXPECT_EQ(scale.share(-5.0), 0.0F);
  EXPECT_NEAR(scale.at(scale.share(1234.0)), 1234.0, 1.0);
  EXPECT_EQ(stiffness_scale({}).share(1.0), 1.0F) << "a scene without walls";
}

TEST(FadedTint, SettlesAndKeepsItsColourWhileItGoes) {
  ShownStiffness shown;
  const ShownStiffness soft{1900.0, 1.0};
  shown = faded(shown, soft, 1.0 / 60.0);
  EXPECT_EQ(shown.n_per_m, 1900.0) << "no colour before this one";
  EXPECT_GT(shown.strength, 0.0);
  EXPECT_LT(shown.strength, 0.5);
  for (int i = 0; i < 120; ++i) shown = faded(shown, soft, 1.0 / 60.0);
  EXPECT_EQ(shown, soft) << "and then stands still";
  shown = faded(shown, {}, 1.0 / 60.0);
  EXPECT_EQ(shown.n_per_m, 1900.0);
  EXPECT_LT(shown.strength, 1.0);
  for (int i = 0; i < 120; ++i) shown = faded(shown, {}, 1.0 / 60.0);
  EXPECT_EQ(shown.strength, 0.0);
}

}  // namespace
}  // namespace hapticwall::draw
