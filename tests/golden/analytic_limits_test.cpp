// The limits of theory come out of the studies: maps and boundaries against b/(T/2 + t_d) and
// 2 f_c / Δ, and against the eigenvalues of the sampled loop, which stable_limit_test.cpp tests.
// docs/maps.md quotes the distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/algorithm/algorithm.h"
#include "core/study/boundary.h"
#include "core/study/stability_bounds.h"
#include "core/study/stability_map.h"
#include "tests/core/study/study_scenes.h"

namespace hapticwall {
namespace {

double eigenvalue_limit(const Scene& scene) {
  return stability_bounds(scene, scene.x().walls[0], delay_of(scene)).stable_n_per_m.value();
}

Boundary largest_stiffness(Scene scene, double expected) {
  BoundaryPlan plan;
  plan.scene = std::move(scene);
  plan.algorithms = {find_algorithm("none").value()};
  plan.along = {find_scene_number(plan.scene, "wall.stiffness_n_per_m").value(), 0.5 * expected,
                2.0 * expected, 5, true};
  plan.tolerance = 1e-5;
  return find_boundaries(plan).front();
}

TEST(AnalyticLimits, ASampledSpringMayHaveTwiceTheDampingOverThePeriod) {
  for (const double mass_kg : {0.05, 0.1, 0.5}) {
    Scene scene = testing::pressed_wall(2000.0);
    scene.x().device.mass_kg = mass_kg;
    scene.duration_s = 4000.0 * mass_kg;
    const double bound = stability_bounds(scene, scene.x().walls[0], {}).passive_n_per_m.value();
    const double exact = eigenvalue_limit(scene);
    const Boundary found = largest_stiffness(scene, bound);
    ASSERT_TRUE(found.settled.last && found.failed.first);
    const std::string name = "mass_" + std::to_string(static_cast<int>(1000 * mass_kg)) + "_g";
    RecordProperty(name + "_bound", std::to_string(bound));
    RecordProperty(name + "_eigenvalues", std::to_string(exact));
    RecordProperty(name + "_map", std::to_string(*found.settled.last));
    EXPECT_NEAR(*found.settled.last / exact, 1.0, 1e-3);
    // 2b/T is of small steps: the first term that it leaves out is (b T / m) / 6; the hand's spring
    // is a thousandth of the wall's.
    const double step = scene.x().device.damping_n_s_per_m * scene.sampling.period_s() / mass_kg;
    EXPECT_NEAR(exact / bound, 1.0 + step / 6.0, 1.5e-3);
    EXPECT_NEAR(*found.settled.last / bound, 1.0, 5e-3);
  }
}

TEST(AnalyticLimits, WithADelayTheDampingOverHalfThePeriodAndTheDelay) {
  for (const int delay : {1, 2, 5, 10}) {
    Scene scene = testing::pressed_wall(500.0);
    scene.x().device.delay_ticks = delay;
    scene.duration_s = 400.0;
    const double bound =
        stability_bounds(scene, scene.x().walls[0], delay_of(scene)).rule_n_per_m.value();
    scene.x().device.start_m = testing::kWallAtM + testing::kPressN / bound + 0.2e-3;
    const double exact = eigenvalue_limit(scene);
    const Boundary found = largest_stiffness(scene, bound);
    ASSERT_TRUE(found.settled.last && found.failed.first);
    const std::string name = "delay_" + std::to_string(delay);
    RecordProperty(name + "_bound", std::to_string(bound));
    RecordProperty(name + "_eigenvalues", std::to_string(exact));
    RecordProperty(name + "_map", std::to_string(*found.settled.last));
    EXPECT_NEAR(*found.settled.last / exact, 1.0, 2e-3);
    EXPECT_NEAR(*found.settled.last / bound, 1.0, 0.1);
  }
}

// Between two counts the force of a wall jumps by K Δ. Where half of that is more than the friction
// holds, some force of the hand finds no rest.
TEST(AnalyticLimits, OfAQuantisedWallIsTwiceTheFrictionOverTheCount) {
  StabilityMap map;
  map.scene = testing::pressed_wall(1000.0);
  map.scene.duration_s = 8.0;
  map.scene.x().device.friction_n = 0.14;
  map.scene.x().device.encoder_m = 0.254e-3;
  map.scene.x().device.start_m = testing::kWallAtM;
  map.algorithms = {find_algorithm("none").value()};
  const double bound =
      stability_bounds(map.scene, map.scene.x().walls[0], {}).friction_n_per_m.value();
  map.x = {find_scene_number(map.scene, "wall.stiffness_n_per_m").value(), 0.9 * bound, 1.1 * bound,
           41, false};
  // About a count's worth of force.
  map.y = {find_scene_number(map.scene, "hand.stiffness_n_per_m").value(), 5.0, 5.35, 36, false};
  const std::vector<MapMetrics> figures = run_cells(map, 0, map.cell_count());
  double softest_restless = std::numeric_limits<double>::infinity();
  double stiffest_at_rest = 0.0;
  for (std::size_t cell = 0; cell < figures.size(); ++cell) {
    const double stiffness = map.x.value(map.place(cell).x);
    // At rest the force does not change at all.
    if (figures[cell].tail_force_std_n.value() > 0.0) {
      softest_restless = std::min(softest_restless, stiffness);
    } else {
      stiffest_at_rest = std::max(stiffest_at_rest, stiffness);
    }
  }
  RecordProperty("bound", std::to_string(bound));
  RecordProperty("softest_restless", std::to_string(softest_restless));
  RecordProperty("stiffest_at_rest", std::to_string(stiffest_at_rest));
  EXPECT_GE(softest_restless, bound) << "no wall softer than the bound finds no rest";
  EXPECT_NEAR(softest_restless / bound, 1.0, 0.02);
  EXPECT_EQ(stiffest_at_rest, map.x.value(map.x.count - 1)) << "a bound for the worst hand only";
}

}  // namespace
}  // namespace hapticwall
