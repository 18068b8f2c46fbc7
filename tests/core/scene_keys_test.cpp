#include "core/scene_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "tests/core/study/study_scenes.h"

namespace hapticwall {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Not;
using ::testing::StartsWith;

Scene tapped() {
  Scene scene = testing::pressed_wall(1000.0);
  scene.x().hand->path = {{0.0, 0.03}, {1.0, 0.05}, {1.5, 0.065}, {2.0, 0.065}};
  return scene;
}

std::vector<std::string> paths(const Scene& scene) {
  std::vector<std::string> all;
  for (const SceneNumber& number : scene_numbers(scene)) all.push_back(number.path);
  return all;
}

TEST(SceneNumbers, AreThoseOfTheScenesOwnTables) {
  EXPECT_THAT(
      paths(tapped()),
      AllOf(Contains("duration_s"), Contains("sampling.rate_hz"), Contains("device.friction_n"),
            Contains("hand.grip_stiffness_n_per_m"), Contains("wall.stiffness_n_per_m"),
            Contains("algorithm.rest_force_step_n"), Contains(std::string(kPathSpeed)),
            // Choices and switches are no numbers.
            Not(Contains("algorithm.then")), Not(Contains("device.chai3d_stiffness_n_per_m"))));
  Scene bare = tapped();
  bare.x().hand.reset();
  bare.x().walls.clear();
  EXPECT_THAT(paths(bare), Each(Not(StartsWith("hand."))));
  EXPECT_THAT(paths(bare), Each(Not(StartsWith("wall"))));
}

TEST(SceneNumbers, EveryOneIsReadBackAsItWasSet) {
  Scene scene = tapped();
  scene.x().walls.push_back({0.06, 500.0, 0.0});
  for (const SceneNumber& number : scene_numbers(scene)) {
    SCOPED_TRACE(number.path);
    Scene changed = scene;
    // Within the range, and not what it was.
    const double value = number.whole ? 7.0 : 0.75 * number.range.maximum + 1e-9;
    number.set(changed, value);
    ASSERT_TRUE(number.get(changed).has_value());
    EXPECT_NEAR(*number.get(changed), value, 1e-12 * value);
    // Nothing else has moved.
    for (const SceneNumber& other : scene_numbers(scene)) {
      if (other.path != number.path) EXPECT_EQ(other.get(changed), other.get(scene)) << other.path;
    }
  }
}

TEST(SceneNumbers, AreFoundByPathAndTheOnlyWallByItsIndexToo) {
  Scene scene = tapped();
  ASSERT_TRUE(find_scene_number(scene, "wall.stiffness_n_per_m"));
  find_scene_number(scene, "wall[0].stiffness_n_per_m")->set(scene, 123.0);
  EXPECT_EQ(scene.x().walls[0].stiffness_n_per_m, 123.0);
  EXPECT_FALSE(find_scene_number(scene, "wall[1].stiffness_n_per_m"));
  EXPECT_FALSE(find_scene_number(scene, "wall.axis"));
  EXPECT_FALSE(find_scene_number(scene, ""));
  scene.x().walls.push_back({0.06, 500.0, 0.0});
  find_scene_number(scene, "wall[1].stiffness_n_per_m")->set(scene, 77.0);
  EXPECT_EQ(scene.x().walls[1].stiffness_n_per_m, 77.0);
  EXPECT_FALSE(find_scene_number(scene, "wall.stiffness_n_per_m"));
}

TEST(SceneNumbers, ASpeedIsThatOfTheFastestPartAndScalesAllTimes) {
  Scene scene = tapped();
  const auto speed = find_scene_number(scene, kPathSpeed);
  ASSERT_TRUE(speed);
  EXPECT_DOUBLE_EQ(*speed->get(scene), 0.03);
  speed->set(scene, 0.3);
  EXPECT_DOUBLE_EQ(scene.x().hand->path[1].time_s, 0.1);
  EXPECT_DOUBLE_EQ(scene.x().hand->path[3].time_s, 0.2);
  EXPECT_DOUBLE_EQ(scene.x().hand->path[2].position_m, 0.065);
  scene.x().hand->path = {{0.0, 0.03}};
  EXPECT_FALSE(find_scene_number(scene, kPathSpeed)) << "a path that rests has no speed";
}

}  // namespace
}  // namespace hapticwall
