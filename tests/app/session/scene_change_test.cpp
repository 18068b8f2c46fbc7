#include "app/session/scene_change.h"

#include <gtest/gtest.h>

#include "tests/app/session/support.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;
using test::plant_changes;

TEST(SceneChange, EverythingOfAPlantMayChange) {
  Scene before = contact_scene();
  for (const Scene& after : plant_changes(before)) {
    EXPECT_FALSE(same_plant(before, after));
    EXPECT_FALSE(same_parameters(before, after));
    EXPECT_FALSE(needs_new_session(before, after));
    before = after;
  }
}

TEST(SceneChange, AWallAnAlgorithmOrAnEstimatorIsNoOtherPlant) {
  const Scene scene = contact_scene();
  Scene wall = scene;
  wall.x().walls[0].damping_n_s_per_m = 1.0;
  const Scene algorithm = test::with_algorithm(scene, 0);
  Scene estimator = scene;
  estimator.estimator.values.front() = 30.0;
  for (const Scene& changed : {wall, algorithm, estimator}) {
    EXPECT_TRUE(same_plant(scene, changed));
    EXPECT_FALSE(needs_new_session(scene, changed));
    EXPECT_FALSE(same_parameters(scene, changed));
  }
  EXPECT_TRUE(same_parameters(scene, scene));
}

TEST(SceneChange, NamesAChangeThatNeedsANewSession) {
  const Scene scene = contact_scene();
  Scene rate = scene;
  rate.sampling.rate_hz = 2000.0;
  Scene start = scene;
  start.x().device.start_m = 0.04;
  Scene path = scene;
  path.x().hand->path.edit().back().position_m = 0.06;
  Scene mouse = scene;
  mouse.x().hand->follows_mouse = true;
  Scene free = scene;
  free.x().hand.reset();
  const auto key = [&](const Scene& wanted) {
    const auto problem = needs_new_session(scene, wanted);
    return problem ? problem->key : "none";
  };
  EXPECT_EQ(key(scene), "none");
  EXPECT_EQ(key(rate), "sampling.rate_hz");
  EXPECT_EQ(key(start), "device.start_m");
  EXPECT_EQ(key(path), "hand.path");
  EXPECT_EQ(key(mouse), "hand.path");
  EXPECT_EQ(key(free), "hand");
  EXPECT_TRUE(needs_new_session(free, scene));
}

}  // namespace
}  // namespace hapticwall::session
