#include "app/ui/wall/wall_measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/ui/wall/stiffness_bar.h"
#include "app/ui/wall/wall_floor.h"
#include "app/ui/wall/wall_renderer.h"
#include "app/ui/wall/wall_solids.h"

namespace hapticwall::ui {
namespace {

const PictureWall kWall{Axis::kX, 0.05, 35000.0};

TEST(ForceArrow, GrowsWithTheForceOutOfTheWallAndEndsAtFullScale) {
  WallPicture picture;
  picture.full_scale_n = 8.9;
  EXPECT_EQ(arrow_of(picture, picture.force_n), glm::vec2(0.0F));
  picture.force_n.x = 4.45;
  EXPECT_NEAR(arrow_of(picture, picture.force_n).x, -0.5F * WallMeasures::kMaxArrow, 1e-5);
  picture.force_n.x = 20.0;
  EXPECT_EQ(arrow_of(picture, picture.force_n).x, -WallMeasures::kMaxArrow);
  picture.force_n.x = -8.9;
  EXPECT_EQ(arrow_of(picture, picture.force_n).x, WallMeasures::kMaxArrow);
  picture.force_n = {80.0, 60.0};
  EXPECT_NEAR(glm::length(arrow_of(picture, picture.force_n)), WallMeasures::kMaxArrow, 1e-5);
  EXPECT_NEAR(arrow_of(picture, picture.force_n).x / arrow_of(picture, picture.force_n).y,
              4.0 / 3.0, 1e-5);
}

TEST(WallSlabs, ReachFromFaceToFaceAndTheHandleStaysOutside) {
  WallPicture picture;
  picture.walls = {{Axis::kX, 0.05, 500.0}, {Axis::kX, 0.056, 3000.0}};
  picture.handle_m = {0.058, 0.0};
  const WallCamera camera(AxisExtent{0.02, 0.08}, 800.0F, 400.0F);
  const WallSlab outer = wall_slab(picture, camera, picture.walls[0]);
  const WallSlab deeper = wall_slab(picture, camera, picture.walls[1]);
  EXPECT_FLOAT_EQ(outer.face, camera.x_of(0.05));
  EXPECT_FLOAT_EQ(outer.end, deeper.face);
  EXPECT_FLOAT_EQ(deeper.end, WallMeasures::kFarEnd);
  EXPECT_FLOAT_EQ(outer.tip, outer.face);
  picture.handle_m = {0.04, 0.0};
  EXPECT_FLOAT_EQ(wall_slab(picture, camera, picture.walls[0]).tip, camera.x_of(0.04));
}

TEST(WallSlabs, TheFarWallIsDrawnFirst) {
  WallPicture picture;
  picture.two_axes = true;
  picture.walls = {{Axis::kX, 0.05, 1.0}, {Axis::kX, 0.055, 2.0}, {Axis::kY, 0.05, 3.0}};
  const WallSpace space{{0.02, 0.08}, AxisExtent{0.02, 0.08}};
  const auto order = [&](double yaw_rad) {
    const WallCamera camera(space, {yaw_rad, 0.0, 1.0, {}}, 800.0F, 400.0F);
    std::vector<double> stiffness;
    for (const WallSlab& slab : wall_slabs(picture, camera))
      stiffness.push_back(slab.wall->stiffness_n_per_m);
    return stiffness;
  };
  EXPECT_EQ(order(0.0), (std::vector<double>{2.0, 1.0, 3.0}));
  EXPECT_EQ(order(1.7), (std::vector<double>{3.0, 1.0, 2.0})) << "from the wall's side";
}

TEST(WallBlock, IsWhereTheWallsOfAnAxisStand) {
  WallPicture picture;
  picture.walls = {{Axis::kX, 0.056, 1.0}, {Axis::kX, 0.05, 2.0}};
  const WallCamera camera(AxisExtent{0.02, 0.08}, 800.0F, 400.0F);
  const auto block = wall_block(picture, camera, Axis::kX);
  ASSERT_TRUE(block.has_value());
  EXPECT_FLOAT_EQ(block->x, camera.x_of(0.05));
  EXPECT_FLOAT_EQ(block->y, WallMeasures::kFarEnd);
  EXPECT_FALSE(wall_block(picture, camera, Axis::kY).has_value());
}

TEST(VisibleSteps, IgnoreInvisibleDifferences) {
  WallPicture picture;
  picture.walls = {kWall};
  picture.handle_m = {0.0500001, 0.0};
  picture.force_n = {5.0001, 0.0};
  picture.shown.front() = {3500.1, 1.0};
  WallPicture nearly = picture;
  nearly.handle_m.x += 1e-7;
  nearly.force_n.x += 1e-4;
  nearly.shown.front().n_per_m += 0.5;
  EXPECT_EQ(in_visible_steps(picture, 1e-5), in_visible_steps(nearly, 1e-5));
  nearly.handle_m.x += 1e-4;
  EXPECT_NE(in_visible_steps(picture, 1e-5), in_visible_steps(nearly, 1e-5));
  EXPECT_NEAR(in_visible_steps(picture, 1e-5).shown.front().n_per_m, 3500.0, 50.0);
}

TEST(GridStep, IsRoundAndHasRoom) {
  EXPECT_NEAR(grid_step_m(0.065), 0.01, 1e-12);
  EXPECT_NEAR(grid_step_m(0.02), 0.002, 1e-12);
  EXPECT_NEAR(grid_step_m(1.5), 0.2, 1e-12);
  for (int i = 0; i < 75; ++i) {
    const double length_m = 0.02 * std::pow(1.07, i);
    const double lines = length_m / grid_step_m(length_m);
    EXPECT_GE(lines, 6.0 - 1e-9) << length_m;
    EXPECT_LE(lines, 15.0 + 1e-9) << length_m;
  }
}

TEST(StiffnessText, IsShort) {
  EXPECT_EQ(stiffness_text(35000.0), "35 kN/m");
  EXPECT_EQ(stiffness_text(350.0), "350 N/m");
  EXPECT_EQ(stiffness_text(1904.2), "1.9 kN/m");
}

}  // namespace
}  // namespace hapticwall::ui
