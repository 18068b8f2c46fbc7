#include "core/study/boundary.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/core/study/study_scenes.h"

namespace hapticwall {
namespace {

BoundaryPlan plan_of(const Scene& scene, const char* path, double low, double high,
                     std::size_t count, bool logarithmic) {
  BoundaryPlan plan;
  plan.scene = scene;
  plan.algorithms = {find_algorithm("none").value()};
  plan.along = {find_scene_number(scene, path).value(), low, high, count, logarithmic};
  return plan;
}

Scene short_press() {
  Scene scene = testing::pressed_wall(1000.0);
  scene.duration_s = 30.0;  // so that a barely stable wall comes to rest
  return scene;
}

Verdict verdict_at(const BoundaryPlan& plan, double value) {
  Scene scene = plan.scene;
  plan.along.number.set(scene, value);
  return simulate(scene).summary.verdict;
}

TEST(Boundaries, LieBetweenAValueThatSettlesAndOneThatDoesNot) {
  BoundaryPlan plan = plan_of(short_press(), "wall.stiffness_n_per_m", 500.0, 8000.0, 9, true);
  plan.tolerance = 1e-5;
  const auto boundaries = find_boundaries(plan);
  ASSERT_EQ(boundaries.size(), 1U);
  const Boundary& found = boundaries.front();
  ASSERT_TRUE(found.settled.last && found.failed.first);
  EXPECT_LT(*found.settled.last, *found.failed.first);
  EXPECT_LE(*found.failed.first - *found.settled.last, 1e-5 * *found.failed.first);
  EXPECT_EQ(found.settled.first, 500.0);
  EXPECT_EQ(found.failed.last, 8000.0);
  EXPECT_EQ(found.changes, 1U);
  EXPECT_EQ(verdict_at(plan, *found.settled.last), Verdict::kSettled);
  EXPECT_NE(verdict_at(plan, *found.failed.first), Verdict::kSettled);
  ASSERT_TRUE(found.at_settled);
  EXPECT_EQ(found.at_settled->verdict, Verdict::kSettled);
}

// A swing just below the limit decays for longer than the run.
TEST(Boundaries, TellTheLimitOfTheoryOfALinearLoop) {
  BoundaryPlan plan = plan_of(short_press(), "wall[0].stiffness_n_per_m", 500.0, 8000.0, 9, true);
  plan.algorithms.push_back(find_algorithm("virtual-coupling").value());
  plan.x = MapAxis{find_scene_number(plan.scene, "device.damping_n_s_per_m").value(), 0.5, 1.0, 2,
                   false};
  const auto found = find_boundaries(plan);
  ASSERT_EQ(found.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(found[i].stable_below_n_per_m && found[i].failed.first);
    EXPECT_NEAR(*found[i].failed.first / *found[i].stable_below_n_per_m, 1.0, 0.02);
    EXPECT_FALSE(found[i + 2].stable_below_n_per_m);
  }
}

TEST(Boundaries, OfAKeyThatStabilisesAreFoundFromBelowToo) {
  Scene scene = short_press();
  scene.x().walls[0].stiffness_n_per_m = 3000.0;
  const auto boundaries =
      find_boundaries(plan_of(scene, "device.damping_n_s_per_m", 0.5, 5.0, 10, false));
  const Boundary& found = boundaries.front();
  EXPECT_FALSE(found.stable_below_n_per_m) << "the stiffness does not vary";
  ASSERT_TRUE(found.settled.first && found.failed.last);
  EXPECT_GT(*found.settled.first, *found.failed.last);
  EXPECT_NEAR(*found.settled.first, 1.5, 0.15) << "b = K T / 2";
  EXPECT_EQ(found.failed.first, 0.5);
  EXPECT_EQ(found.settled.last, 5.0);
}

TEST(Boundaries, SayWhereThereIsNone) {
  const auto quiet =
      find_boundaries(plan_of(short_press(), "wall.stiffness_n_per_m", 100.0, 1000.0, 4, false));
  EXPECT_EQ(quiet.front().settled.first, 100.0);
  EXPECT_EQ(quiet.front().settled.last, 1000.0);
  EXPECT_FALSE(quiet.front().failed.first || quiet.front().failed.last);
  EXPECT_EQ(quiet.front().changes, 0U);
  const auto loud =
      find_boundaries(plan_of(short_press(), "wall.stiffness_n_per_m", 5000.0, 8000.0, 4, false));
  EXPECT_FALSE(loud.front().settled.first || loud.front().settled.last);
  EXPECT_EQ(loud.front().failed.first, 5000.0);
  EXPECT_EQ(loud.front().failed.last, 8000.0);
  EXPECT_FALSE(loud.front().at_settled);
}

TEST(Boundaries, OfAKeyThatCountsAreNeighbours) {
  Scene scene = short_press();
  scene.x().walls[0].stiffness_n_per_m = 300.0;
  const auto boundaries =
      find_boundaries(plan_of(scene, "device.delay_ticks", 0.0, 20.0, 5, false));
  const Boundary& found = boundaries.front();
  ASSERT_TRUE(found.settled.last && found.failed.first);
  EXPECT_EQ(*found.failed.first - *found.settled.last, 1.0);
  EXPECT_EQ(*found.settled.last, std::round(*found.settled.last));
}

TEST(Boundaries, AreFoundForEveryValueOfXAndEveryAlgorithm) {
  BoundaryPlan plan = plan_of(short_press(), "wall.stiffness_n_per_m", 500.0, 16000.0, 6, true);
  plan.algorithms.push_back(find_algorithm("virtual-coupling").value());
  plan.x = MapAxis{find_scene_number(plan.scene, "device.damping_n_s_per_m").value(), 1.0, 3.0, 3,
                   false};
  const auto boundaries = find_boundaries(plan);
  ASSERT_EQ(boundaries.size(), 6U);
  for (std::size_t i = 0; i < 3; ++i) {
    const double damping = 1.0 + static_cast<double>(i);
    EXPECT_EQ(boundaries[i].algorithm, 0U);
    EXPECT_EQ(boundaries[i].x, damping);
    EXPECT_NEAR(boundaries[i].settled.last.value(), 2000.0 * damping, 200.0 * damping);
    EXPECT_EQ(boundaries[3 + i].algorithm, 1U);
    EXPECT_FALSE(boundaries[3 + i].failed.first) << "a virtual coupling takes any wall";
  }
}

// `press` without an algorithm: a scan of its own in steps of 25 N/m beside the search.
TEST(Boundaries, AreTheFirstFailureAndTheLastSettledValueBeyondIslands) {
  Scene scene;
  scene.x().device.friction_n = 0.14;
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().hand = HandSettings{0.4, 250.0, 33.0, 1000.0, 1.0, {{0.0, 0.03}, {1.5, 0.075}}, false};
  scene.x().walls = {{0.05, 1000.0, 0.0}};
  const BoundaryPlan plan = plan_of(scene, "wall.stiffness_n_per_m", 2000.0, 8000.0, 241, false);
  std::vector<double> settled;
  std::vector<double> failed;
  for (double value = 2000.0; value <= 8000.0; value += 25.0) {
    const bool settles = verdict_at(plan, value) == Verdict::kSettled;
    if (settles) settled.push_back(value);
    if (!settles) failed.push_back(value);
  }
  const Boundary found = find_boundaries(plan).front();
  EXPECT_GT(found.changes, 2U);
  EXPECT_LE(found.failed.first.value(), failed.front());
  EXPECT_GT(*found.failed.first, failed.front() - 25.0);
  EXPECT_GE(found.settled.last.value(), settled.back());
  EXPECT_LT(*found.settled.last, settled.back() + 25.0);
  EXPECT_NE(verdict_at(plan, *found.failed.first), Verdict::kSettled);
  EXPECT_EQ(verdict_at(plan, *found.settled.last), Verdict::kSettled);
}

TEST(Boundaries, TellProgressAndStop) {
  BoundaryPlan plan = plan_of(short_press(), "wall.stiffness_n_per_m", 500.0, 8000.0, 9, true);
  double last = 0.0;
  BoundaryOptions options;
  options.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    last = fraction;
  };
  EXPECT_FALSE(find_boundaries(plan, options).empty());
  EXPECT_GT(last, 0.5);
  std::atomic<int> asked = 0;
  options.progress = {};
  options.should_stop = [&] { return ++asked > 3; };
  EXPECT_TRUE(find_boundaries(plan, options).empty());
}

TEST(Boundaries, AnInvalidValueIsNamed) {
  const auto problem = validate(plan_of(short_press(), "device.mass_kg", -1.0, 1.0, 3, false));
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->key, "device.mass_kg");
}

}  // namespace
}  // namespace hapticwall
