// --set KEY=VALUE on a scene.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::file {
namespace {

constexpr const char* kOneWall = R"(
[device]
mass_kg = 0.05
damping_n_s_per_m = 1
[[wall]]
position_m = 0.05
stiffness_n_per_m = 35000
)";
constexpr const char* kTwoWalls = R"(
[device]
mass_kg = 0.05
damping_n_s_per_m = 1
[[wall]]
position_m = 0.05
stiffness_n_per_m = 1000
[[wall]]
position_m = 0.06
stiffness_n_per_m = 2000
)";

Scene changed(const std::string& text, const std::vector<std::string>& overrides) {
  const Result<LoadedScene> loaded = parse_scene(text, "x.toml", overrides);
  EXPECT_TRUE(loaded) << loaded.error().message;
  return loaded ? loaded->scene : Scene{};
}

TEST(Override, ReplacesAndAdds) {
  const Scene scene = changed(kOneWall, {"device.mass_kg=0.2", "device.encoder_m = 1e-4",
                                         "sampling.rate_hz=500", "name=two words"});
  EXPECT_EQ(scene.x().device.mass_kg, 0.2);
  EXPECT_EQ(scene.x().device.encoder_m, 1e-4);
  EXPECT_EQ(scene.sampling.rate_hz, 500.0);
  EXPECT_EQ(scene.name, "two words");
}

TEST(Override, TheLastOneCounts) {
  EXPECT_EQ(changed(kOneWall, {"duration_s=1", "duration_s=2"}).duration_s, 2.0);
}

TEST(Override, BareWordsAreStrings) {
  EXPECT_EQ(changed(kOneWall, {"algorithm.name=energy-bounding"}).algorithm.index,
            find_algorithm("energy-bounding"));
  EXPECT_EQ(changed(kOneWall, {"algorithm.name=\"none\""}).algorithm.index, find_algorithm("none"));
  EXPECT_TRUE(changed(kOneWall, {"hand.path=mouse"}).x().hand->follows_mouse);
}

TEST(Override, AWordForAlgorithmOrEstimatorIsItsName) {
  const Scene scene =
      changed(kOneWall, {"algorithm.then=passivity-control", "algorithm=energy-bounding",
                         "estimator=backward-difference"});
  EXPECT_EQ(scene.algorithm.index, find_algorithm("energy-bounding"));
  EXPECT_TRUE(has_follower(scene.algorithm)) << "the other keys stay";
  EXPECT_EQ(scene.estimator, EstimatorSettings{});
  EXPECT_EQ(changed(kOneWall, {"algorithm={name='half-sample'}"}).algorithm.index,
            find_algorithm("half-sample"));
}

TEST(Override, AScalarOfNumPyIsItsNumber) {
  const Scene scene = changed(
      kOneWall, {"wall.stiffness_n_per_m=np.float64(300.0)", "device.delay_ticks= np.int64(2) "});
  EXPECT_EQ(scene.x().walls[0].stiffness_n_per_m, 300.0);
  EXPECT_EQ(scene.x().device.delay_ticks, 2);
}

TEST(Override, WholeTablesAndPaths) {
  const Scene scene =
      changed(kOneWall, {"hand.path=[[0, 0.03], [1, 0.06]]", "hand.stiffness_n_per_m=300"});
  ASSERT_TRUE(scene.x().hand);
  EXPECT_EQ(scene.x().hand->path, (SharedPath{{0.0, 0.03}, {1.0, 0.06}}));
  EXPECT_TRUE(changed(kOneWall, {"wall=[]"}).x().walls.empty());
}

TEST(Override, Walls) {
  EXPECT_EQ(changed(kOneWall, {"wall.stiffness_n_per_m=7"}).x().walls[0].stiffness_n_per_m, 7.0);
  EXPECT_EQ(changed(kOneWall, {"wall[0].damping_n_s_per_m=7"}).x().walls[0].damping_n_s_per_m, 7.0);
  const Scene scene = changed(kTwoWalls, {"wall[1].stiffness_n_per_m=7"});
  EXPECT_EQ(scene.x().walls[0].stiffness_n_per_m, 1000.0);
  EXPECT_EQ(scene.x().walls[1].stiffness_n_per_m, 7.0);
}

}  // namespace
}  // namespace hapticwall::file
