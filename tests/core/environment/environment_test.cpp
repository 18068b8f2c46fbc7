#include "core/environment/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "core/scene_keys.h"
#include "tests/position_bench.h"

namespace hapticwall {
namespace {

Scene scene_in(std::string_view environment,
               const std::vector<std::pair<std::string, double>>& values = {}) {
  Scene scene;
  scene.environment.index = find_environment(environment).value();
  for (const auto& [key, value] : values)
    find_scene_number(scene, "environment." + key).value().set(scene, value);
  return scene;
}

std::vector<double> forces(const Scene& scene, const std::vector<double>& positions_m) {
  testing::PositionBench bench(servo_settings(scene));
  std::vector<double> forces_n;
  for (const double position_m : positions_m)
    forces_n.push_back(bench.move_to(position_m).wall_force_n);
  return forces_n;
}

TEST(EnvironmentList, EveryNameIsItsOwnAndFoundAgain) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < environments().size(); ++i) {
    if (environments()[i].plugin != nullptr) continue;  // of another test in this process
    const EnvironmentDescription& one = environments()[i].description;
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_EQ(find_environment(one.name), i);
    EXPECT_FALSE(one.title.empty() || one.idea.empty() || one.equation.empty());
    for (const ParameterDescription& parameter : one.parameters)
      EXPECT_FALSE(parameter.meaning.empty() || parameter.default_text.empty()) << parameter.key;
    for (const SignalDescription& signal : one.signals)
      EXPECT_TRUE(find_algorithm_signal(signal.name)) << signal.name;
  }
  EXPECT_EQ(find_environment("no-such-thing"), std::nullopt);
}

TEST(EnvironmentList, TheDefaultIsTheInlineWalls) {
  EXPECT_EQ(find_environment("walls"), EnvironmentSettings{}.index);
  EXPECT_EQ(servo_settings(Scene{}).environment, nullptr);
}

TEST(EnvironmentList, ASceneTakesNoIndexOutsideItAndNoWallsBesideAnother) {
  Scene scene;
  scene.environment.index = environments().size();
  ASSERT_TRUE(validate(scene));
  EXPECT_EQ(validate(scene)->key, "environment.name");
  scene = scene_in("detents");
  EXPECT_FALSE(validate(scene));
  scene.x().walls.resize(1);
  ASSERT_TRUE(validate(scene));
  EXPECT_EQ(validate(scene)->key, "wall");
}

// (p/p_0)^n for p/p_0 = 1/16 is a power of two for every exponent.
TEST(HuntCrossley, HasItsForceForEachExponent) {
  const std::vector<std::pair<double, double>> powers{
      {1.0, 1.0 / 16},  {1.25, 1.0 / 32},  {1.5, 1.0 / 64},   {1.75, 1.0 / 128},
      {2.0, 1.0 / 256}, {2.5, 1.0 / 1024}, {4.0, 1.0 / 65536}};
  for (const auto& [exponent, power] : powers) {
    const Scene scene = scene_in("hunt-crossley", {{"position_m", 0.0},
                                                   {"reference_depth_m", 0.5},
                                                   {"reference_force_n", 8.0},
                                                   {"exponent", exponent}});
    ASSERT_FALSE(validate(scene));
    EXPECT_DOUBLE_EQ(forces(scene, {0.03125}).front(), 8.0 * power) << exponent;
  }
}

TEST(HuntCrossley, DampsByItsDepthAndNeverPulls) {
  const Scene scene = scene_in("hunt-crossley", {{"position_m", 0.0},
                                                 {"reference_depth_m", 0.01},
                                                 {"exponent", 1.0},
                                                 {"dissipation_s_per_m", 2.0}});
  // 5 N at 10 mm: 0.5 N at 1 mm and rest; +1 m/s doubles and adds: 1 + 2 v.
  const auto found = forces(scene, {0.0, 1e-3, 1e-3, 0.5e-3, -1e-3});
  EXPECT_DOUBLE_EQ(found[0], 0.0);
  EXPECT_DOUBLE_EQ(found[1], 0.5 * 3.0);
  EXPECT_DOUBLE_EQ(found[2], 0.5);
  EXPECT_DOUBLE_EQ(found[3], 0.0) << "1 + 2 (-0.5) = 0";
  EXPECT_DOUBLE_EQ(found[4], 0.0);
}

TEST(HuntCrossley, TakesQuartersAsExponentAlone) {
  const auto problem = validate(scene_in("hunt-crossley", {{"exponent", 1.3}}));
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->key, "environment.exponent");
}

TEST(Detents, HoldTheHandleAtEveryPlace) {
  const Scene scene =
      scene_in("detents", {{"position_m", 0.01}, {"detent_force_n", 3.0}, {"spacing_m", 0.004}});
  const auto found = forces(scene, {0.01, 0.011, 0.012, 0.013, 0.022, 0.009});
  const std::vector<double> by_hand{0.0, 3.0, 0.0, -3.0, 0.0, -3.0};
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], by_hand[i], 1e-12) << i;
}

// T = 1 ms, M = 0.5 kg, K = 1000 N/m: T²K/M = 0.002. The mass is where the handle was, then moves
// by 0.002 of the stretch of each tick, and keeps its speed.
TEST(VirtualMass, MovesByTheSemiImplicitRule) {
  const Scene scene = scene_in("virtual-mass", {{"mass_kg", 0.5}, {"stiffness_n_per_m", 1000.0}});
  const auto found = forces(scene, {0.0, 1e-3, 1e-3, 1e-3});
  EXPECT_DOUBLE_EQ(found[0], 0.0);
  EXPECT_NEAR(found[1], 1.0, 1e-12);
  EXPECT_NEAR(found[2], 1.0 - 0.002, 1e-12);             // m = 2 µm
  EXPECT_NEAR(found[3], 1.0 - 0.002 - 0.003996, 1e-12);  // + 2 µm + 1.996 µm
}

TEST(VirtualMass, BeginsAtTheHandleAgainAfterAReset) {
  testing::PositionBench bench(servo_settings(scene_in("virtual-mass")));
  for (const double position_m : {0.0, 0.01, 0.02}) (void)bench.move_to(position_m);
  bench.reset();
  EXPECT_EQ(bench.move_to(0.5).wall_force_n, 0.0);
  EXPECT_EQ(bench.move_to(0.5).wall_force_n, 0.0);
}

TEST(VirtualMass, IsAtTheHandleFromTheTickAfterTheForceHasGone) {
  testing::PositionBench bench(servo_settings(scene_in("virtual-mass")));
  for (const double position_m : {0.0, 0.01, 0.02}) (void)bench.move_to(position_m);
  bench.servo().state().force_gain = 0.0;
  EXPECT_GT(bench.move_to(0.03).wall_force_n, 10.0);
  for (const double position_m : {0.04, 0.05, 0.06})
    EXPECT_EQ(bench.move_to(position_m).wall_force_n, 0.0);
}

TEST(Bump, PushesUphillWithItsSlope) {
  const Scene scene = scene_in(
      "bump", {{"centre_x_m", 0.0}, {"height_m", 0.004}, {"width_m", 0.01}, {"weight_n", 5.0}});
  // A H/σ e^{-1/2} at one width from the top, where the slope is steepest.
  const double steepest_n = 5.0 * 0.4 * std::exp(-0.5);
  const auto found = forces(scene, {-0.01, 0.0, 0.01, 0.03});
  EXPECT_NEAR(found[0], steepest_n, 1e-12);
  EXPECT_DOUBLE_EQ(found[1], 0.0);
  EXPECT_NEAR(found[2], -steepest_n, 1e-12);
  EXPECT_NEAR(found[3], -5.0 * 0.4 * 3.0 * std::exp(-4.5), 1e-12);
}

// The walls of a loop do not share the code of an environment.
TEST(HuntCrossley, OfAStraightSpringIsAWallUnderEveryAlgorithm) {
  constexpr double kStiffness = 3000.0;
  for (std::size_t algorithm = 0; algorithm < algorithms().size(); ++algorithm) {
    SCOPED_TRACE(std::string(algorithms()[algorithm].name));
    Scene tissue = scene_in("hunt-crossley", {{"position_m", 0.05},
                                              {"reference_force_n", kStiffness * 0.01},
                                              {"reference_depth_m", 0.01},
                                              {"exponent", 1.0},
                                              {"dissipation_s_per_m", 0.0}});
    tissue.algorithm.index = algorithm;
    tissue.x().device.damping_n_s_per_m = 1.0;
    Scene wall = tissue;
    wall.environment = {};
    wall.x().walls = {{.position_m = 0.05, .stiffness_n_per_m = kStiffness}};
    testing::PositionBench in_tissue(servo_settings(tissue));
    testing::PositionBench in_wall(servo_settings(wall));
    double peak_n = 0.0;
    for (int k = 0; k < 400; ++k) {
      const double position_m = 0.05 + 2e-3 * std::sin(0.05 * k) + 3e-4 * std::sin(0.9 * k);
      const Sample expected = in_wall.move_to(position_m);
      const Sample found = in_tissue.move_to(position_m);
      ASSERT_NEAR(found.force_n, expected.force_n, 1e-9) << k;
      ASSERT_NEAR(found.penetration_m, expected.penetration_m, 1e-15) << k;
      peak_n = std::max(peak_n, found.force_n);
    }
    EXPECT_GT(peak_n, 1.0);
  }
}

// A controller that computes in every second tick has twice the period: T²K/M = 4 · 0.002.
TEST(VirtualMass, MovesOnceForEachComputation) {
  Scene scene = scene_in("virtual-mass", {{"mass_kg", 0.5}, {"stiffness_n_per_m", 1000.0}});
  scene.sampling.render_every = 2;
  const auto found = forces(scene, {0.0, 0.0, 1e-3, 1e-3, 1e-3});
  EXPECT_NEAR(found[2], 1.0, 1e-12);
  EXPECT_NEAR(found[3], 1.0 - 0.008, 1e-12) << "the mass has moved by its only step";
  EXPECT_NEAR(found[4], 1.0 - 0.008, 1e-12);
}

TEST(Environments, AllAlgorithmsRunInEach) {
  for (std::size_t environment = 1; environment < environments().size(); ++environment) {
    if (environments()[environment].plugin != nullptr) continue;
    for (std::size_t algorithm = 0; algorithm < algorithms().size(); ++algorithm) {
      Scene scene = scene_in(environments()[environment].description.name);
      scene.algorithm.index = algorithm;
      scene.duration_s = 0.5;
      HandSettings& hand = scene.x().hand.emplace();
      hand.stiffness_n_per_m = 300.0;
      hand.damping_n_s_per_m = 5.0;
      hand.path = {{0.0, 0.03}, {0.3, 0.06}};
      ASSERT_FALSE(validate(scene));
      const Summary summary = simulate(scene).summary;
      EXPECT_FALSE(summary.diverged_at_tick) << environments()[environment].description.name;
      EXPECT_GT(summary.peak_force_n, 0.1)
          << environments()[environment].description.name << " " << algorithms()[algorithm].name;
    }
  }
}

}  // namespace
}  // namespace hapticwall
