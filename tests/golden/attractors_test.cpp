// Energy bounding is quiet or swings by centimetres, as the contact begins: the edges between both
// that docs/maps.md quotes.
#include <gtest/gtest.h>

#include "app/file/scene_file.h"
#include "core/stabiliser/stabiliser.h"
#include "core/study/boundary.h"

namespace hapticwall {
namespace {

Boundary edge(const char* path, double low, double high) {
  BoundaryPlan plan;
  plan.scene = file::load_scene("tap")->scene;
  plan.algorithms = {find_algorithm("energy-bounding").value()};
  plan.along = {find_scene_number(plan.scene, path).value(), low, high, 41, true};
  return find_boundaries(plan).front();
}

TEST(Attractors, ASlowTapIsQuietAndAFastOneIsNot) {
  const Boundary speed = edge("hand.path_speed_m_per_s", 0.01, 1.0);
  EXPECT_EQ(speed.changes, 1U);
  EXPECT_NEAR(speed.settled.value(), 0.0371, 0.0371 * 0.1);
  EXPECT_GT(speed.unsettled.value(), *speed.settled);
}

TEST(Attractors, OfADampedHandThereIsOnlyTheQuietOne) {
  const Boundary damping = edge("hand.damping_n_s_per_m", 1.0, 100.0);
  EXPECT_EQ(damping.changes, 1U);
  EXPECT_NEAR(damping.settled.value(), 13.3, 1.33);
  EXPECT_LT(damping.unsettled.value(), *damping.settled);
}

}  // namespace
}  // namespace hapticwall
