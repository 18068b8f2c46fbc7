// The limit of theory that maps and window show, against the eigenvalues of the sampled loop by a
// second derivation, which shares only the scene's numbers with it; against published values; and
// against runs of the simulator. docs/physics.md quotes the distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/study/boundary.h"
#include "core/study/stability_bounds.h"
#include "tests/core/study/study_scenes.h"
#include "tests/golden/loop_eigenvalues.h"

namespace hapticwall {
namespace {

// The softest unstable wall, or nullopt if walls of 1 N/m are unstable.
std::optional<double> eigenvalue_limit(const Scene& scene, double delay_s) {
  constexpr double kScan = 1.1;
  constexpr double kStiffest = 1e8;
  const testing::LoopEigenvalues loop(scene, delay_s);
  double found = 1.0;
  if (loop.growth(found) > 1.0L) return std::nullopt;
  while (loop.growth(found) < 1.0L && found < kStiffest) found *= kScan;
  long double low = found / kScan;
  long double high = found;
  while (high - low > 1e-12L * high) {
    const long double middle = 0.5L * (low + high);
    (loop.growth(middle) < 1.0L ? low : high) = middle;
  }
  return static_cast<double>(low);
}

// ---- scenes ----

std::optional<HandSettings> some_hand(testing::Random& random, int kind) {
  if (kind == 0) return std::nullopt;
  HandSettings hand;
  hand.stiffness_n_per_m = random.ratio(1.0, 1000.0);
  hand.damping_n_s_per_m = random.ratio(0.1, 50.0);
  if (kind > 1) hand.mass_kg = random.ratio(0.01, 1.0);
  if (kind > 2) {
    hand.grip_stiffness_n_per_m = random.ratio(100.0, 1e5);
    hand.grip_damping_n_s_per_m = random.ratio(0.1, 30.0);
  }
  return hand;
}

// Kinds of hand take turns: none, spring and damper, with a mass, with a grip.
Scene some_scene(testing::Random& random, int i) {
  Scene scene;
  scene.sampling.rate_hz = random.ratio(300.0, 10e3);
  DeviceSettings& device = scene.x().device;
  device.mass_kg = random.ratio(0.01, 1.0);
  device.damping_n_s_per_m = random.ratio(0.1, 10.0);
  device.delay_ticks = random.upto(6);
  if (i % 3 == 1)
    device.amplifier_time_constant_s = random.ratio(0.05, 3.0) / scene.sampling.rate_hz;
  scene.x().hand = some_hand(random, i % 4);
  const double unit = device.mass_kg * scene.sampling.rate_hz;
  scene.x().walls = {{0.05, 1000.0, i % 5 == 0 ? 0.0 : unit * random.ratio(0.005, 0.5)}};
  return scene;
}

double shown_limit(const Scene& scene, const LoopDelay& delay) {
  return stability_bounds(scene, scene.x().walls[0], delay).stable_n_per_m.value();
}

TEST(StableLimit, IsThatOfTheEigenvaluesOfASecondDerivation) {
  testing::Random random(20261123);
  double worst = 0.0;
  int stable = 0;
  for (int i = 0; i < 60; ++i) {
    const Scene scene = some_scene(random, i);
    LoopDelay delay = delay_of(scene);
    // A real device's delay may end within a tick.
    if (i % 6 == 5) delay.transport_s += 0.37 * scene.sampling.period_s();
    const double limit = shown_limit(scene, delay);
    const auto expected = eigenvalue_limit(scene, delay.transport_s);
    if (!expected) {
      EXPECT_LT(limit, 1.0) << i;
      continue;
    }
    ++stable;
    worst = std::max(worst, std::abs(limit / *expected - 1.0));
    EXPECT_NEAR(limit / *expected, 1.0, 1e-9) << i << " limit " << limit;
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
  RecordProperty("stable", stable);
  EXPECT_GT(stable, 40);
}

TEST(StableLimit, IsThatOfTheNormalisedChart) {
  struct Row {
    double damping;
    std::array<double, 3> limits;
  };
  Scene scene;
  scene.x().walls = {{}};
  const auto limit = [&](double damping, int delay) {
    scene.x().walls[0].damping_n_s_per_m = 50.0 * damping;
    scene.x().device.delay_ticks = delay;
    return shown_limit(scene, delay_of(scene)) * 1e-6 / 0.05;
  };
  for (const Row& row : {Row{0.0, {0.0401, 0.0134, 0.0081}}, Row{0.05, {0.1337, 0.0444, 0.0263}},
                         Row{0.2, {0.3620, 0.1148, 0.0625}}, Row{0.4, {0.5644, 0.1544, 0.0582}}}) {
    for (int delay = 0; delay < 3; ++delay) {
      EXPECT_NEAR(limit(row.damping, delay), row.limits.at(static_cast<std::size_t>(delay)),
                  0.5e-4);
    }
  }
  EXPECT_NEAR(limit(0.82, 0), 0.713, 0.5e-3);
  EXPECT_NEAR(limit(0.43, 1), 0.155, 0.5e-3);
  EXPECT_NEAR(limit(0.29, 2), 0.069, 0.5e-3);
  // The last dampings are 2.03, 0.84 and 0.55.
  EXPECT_GT(limit(2.025, 0), 0.0);
  EXPECT_EQ(limit(2.035, 0), 0.0);
  EXPECT_GT(limit(0.835, 1), 0.0);
  EXPECT_EQ(limit(0.845, 1), 0.0);
  EXPECT_GT(limit(0.545, 2), 0.0);
  EXPECT_EQ(limit(0.555, 2), 0.0);
}

TEST(StableLimit, IsZeroWithoutAnyDamping) {
  Scene scene;
  scene.x().device.damping_n_s_per_m = 0.0;
  scene.x().walls = {{}};
  EXPECT_EQ(shown_limit(scene, {}), 0.0);
  scene.x().walls[0].damping_n_s_per_m = 1.0;
  EXPECT_GT(shown_limit(scene, {}), 1000.0);
}

TEST(StableLimit, ChangesLittleWithTheEndOfTheDelayWithinTheTick) {
  Scene scene;
  scene.x().walls = {{0.05, 1000.0, 2.0}};
  double last = shown_limit(scene, {.transport_s = 0.0, .time_constant_s = 0.0});
  for (int i = 1; i <= 300; ++i) {
    const double limit = shown_limit(scene, {.transport_s = 1e-5 * i, .time_constant_s = 0.0});
    EXPECT_LT(limit, last) << i;
    EXPECT_GT(limit, 0.96 * last) << i;
    last = limit;
  }
}

TEST(StableLimit, KnowsAHandThatHoldsNothingOrWithoutASpring) {
  Scene scene;
  scene.x().walls = {{0.05, 1000.0, 2.0}};
  const double alone = shown_limit(scene, {});
  HandSettings hand;
  hand.mass_kg = 0.3;
  hand.stiffness_n_per_m = 200.0;
  hand.grip_stiffness_n_per_m = 0.0;
  scene.x().hand = hand;
  EXPECT_DOUBLE_EQ(shown_limit(scene, {}), alone);
  scene.x().hand->grip_damping_n_s_per_m = 1e-3;
  EXPECT_NEAR(shown_limit(scene, {}) / alone, 1.0, 1e-3);
  scene.x().hand->stiffness_n_per_m = 0.0;  // the hand may stay anywhere: no wall moves it
  EXPECT_NEAR(shown_limit(scene, {}) / alone, 1.0, 1e-3);
}

// A light hand on a loose grip swings by itself; the wall excites it or damps it.
TEST(StableLimit, SeesAResonanceOfTheHand) {
  for (const double grip_n_per_m : {10.0, 1000.0, 1e4, 1e5}) {
    Scene scene;
    HandSettings hand;
    hand.mass_kg = 2e-3;
    hand.grip_stiffness_n_per_m = grip_n_per_m;
    hand.grip_damping_n_s_per_m = 1e-3;
    scene.x().hand = hand;
    scene.x().device.delay_ticks = 1;
    scene.x().walls = {{0.05, 1000.0, 5.0}};
    const double limit = shown_limit(scene, delay_of(scene));
    const auto expected = eigenvalue_limit(scene, 1e-3);
    EXPECT_NEAR(limit, expected.value_or(0.0), 1e-8 * limit + 1.0) << grip_n_per_m;
  }
}

// A heavy hand that swings slowly is unstable only from 33.9 to about 45 N/m; stiffer walls are
// stable again. The limit is the first failure.
TEST(StableLimit, IsTheFirstOfSeveral) {
  Scene scene;
  scene.sampling.rate_hz = 3739.69;
  scene.x().device.mass_kg = 0.0164632;
  scene.x().device.damping_n_s_per_m = 0.022193;
  scene.x().device.delay_ticks = 5;
  scene.x().device.amplifier_time_constant_s = 2.61852e-5;
  scene.x().hand = HandSettings{0.153871, 360.409, 0.0252831, 32.214, 1.06342, {}, false};
  scene.x().walls = {{0.05, 1000.0, 0.0}};
  const LoopDelay delay = delay_of(scene);
  EXPECT_NEAR(shown_limit(scene, delay), 33.86, 0.01);
  const testing::LoopEigenvalues loop(scene, delay.transport_s);
  EXPECT_GT(loop.growth(40.0L), 1.0L);
  EXPECT_LT(loop.growth(100.0L), 1.0L);
}

// ---- the simulator ----

// Pressed into the wall by 4.75 N, as in pressed_wall().
Scene pressed(int delay, double lag_s, double wall_damping, int kind) {
  Scene scene = testing::pressed_wall(1000.0);
  scene.x().walls[0].damping_n_s_per_m = wall_damping;
  if (delay > 0) scene.x().device.delay_ticks = delay;
  if (lag_s > 0.0) scene.x().device.amplifier_time_constant_s = lag_s;
  HandSettings& hand = *scene.x().hand;
  if (kind > 0) hand.damping_n_s_per_m = 0.5;
  if (kind > 1) hand.mass_kg = 0.1;
  if (kind > 2) {
    hand.grip_stiffness_n_per_m = 2000.0;
    hand.grip_damping_n_s_per_m = 2.0;
  }
  const double limit = shown_limit(scene, delay_of(scene));
  scene.x().device.start_m = testing::kWallAtM + testing::kPressN / limit +
                             std::min(0.2e-3, 0.5 * testing::kPressN / limit);
  scene.duration_s = wall_damping > 0.0 ? 300.0 : 1500.0;  // a swing decays slowly without
  return scene;
}

TEST(StableLimit, PartsTheWallsThatSettleInTheSimulatorFromThoseThatDoNot) {
  constexpr double kDistance = 1e-3;
  double settled_below = 0.0;  // the largest distances
  double failed_below = 0.0;
  double settled_above = 0.0;
  int points = 0;
  for (const int delay : {0, 1, 3}) {
    for (const double lag_s : {0.0, 0.7e-3}) {
      for (const double damping : {0.0, 2.0, 8.0}) {
        const int kind = points % 4;
        const Scene scene = pressed(delay, lag_s, damping, kind);
        const double limit = shown_limit(scene, delay_of(scene));
        BoundaryPlan plan;
        plan.scene = scene;
        plan.algorithms = {find_algorithm("none").value()};
        plan.along = {find_scene_number(scene, "wall.stiffness_n_per_m").value(), 0.7 * limit,
                      1.4 * limit, 7, true};
        plan.tolerance = 1e-5;
        const Boundary found = find_boundaries(plan).front();
        const std::string name = std::to_string(delay) + " ticks, lag " + std::to_string(lag_s) +
                                 ", B " + std::to_string(damping) + ", hand " +
                                 std::to_string(kind);
        ASSERT_TRUE(found.settled.last && found.failed.first) << name;
        EXPECT_EQ(found.changes, 1U) << name;
        EXPECT_LE(*found.settled.last, limit * (1.0 + 1e-9)) << name;
        EXPECT_GE(*found.settled.last, limit * (1.0 - kDistance)) << name;
        EXPECT_GE(*found.failed.first, limit * (1.0 - kDistance)) << name;
        settled_below = std::max(settled_below, 1.0 - *found.settled.last / limit);
        settled_above = std::max(settled_above, *found.settled.last / limit - 1.0);
        failed_below = std::max(failed_below, 1.0 - *found.failed.first / limit);
        ++points;
      }
    }
  }
  RecordProperty("points", points);
  RecordProperty("settled_below", std::to_string(settled_below));
  RecordProperty("settled_above", std::to_string(settled_above));
  RecordProperty("failed_below", std::to_string(failed_below));
}

// ---- the rule ----

TEST(StableLimit, IsMissedByTheRuleByAtMost16PercentWithinItsRange) {
  Scene scene;
  scene.x().walls = {{}};
  for (const double damping : {0.0, 0.02, 0.05, 0.1, 0.2, 0.4}) {
    scene.x().walls[0].damping_n_s_per_m = 50.0 * damping;
    for (int delay = 0; delay < 3; ++delay) {
      scene.x().device.delay_ticks = delay;
      const StabilityBounds bounds = stability_bounds(scene, scene.x().walls[0], delay_of(scene));
      const double over = *bounds.rule_n_per_m / *bounds.stable_n_per_m - 1.0;
      RecordProperty("over_" + std::to_string(static_cast<int>(100.0 * damping)) + "_delay_" +
                         std::to_string(delay),
                     std::to_string(over));
      if (damping <= kMaxRuleDamping) {
        EXPECT_GT(over, -0.01);
        EXPECT_LT(over, 0.16) << damping << " " << delay;
      } else {
        EXPECT_GT(over, 0.2);
      }
    }
  }
}

}  // namespace
}  // namespace hapticwall
