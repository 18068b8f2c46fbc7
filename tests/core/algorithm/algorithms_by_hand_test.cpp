// Each algorithm on a few moves that a person can follow by hand: b = 1 N·s/m and T = 1 ms, so that
// b/T = 1000 N/m. reference_algorithms_test.cpp has all parameters and ten thousand sequences.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "core/tick/servo.h"
#include "tests/position_bench.h"

namespace hapticwall {
namespace {

using testing::PositionBench;
using testing::set_parameter;

constexpr double kNear = 1e-12;

ServoSettings wall_at_zero(std::string_view algorithm, double stiffness) {
  ServoSettings settings;
  settings.device_damping_n_s_per_m = 1.0;
  const std::array<WallSettings, 1> walls{WallSettings{0.0, stiffness, 0.0}};
  settings.walls = WallSet(walls);
  settings.algorithm.index = find_algorithm(algorithm).value();
  return settings;
}

// Paper, section 3.2: b = 1, Δ = 0.1 mm, T = 1 ms: 0.1 N per count of motion, ten ticks to reach 1
// N.
TEST(EnergyBounding, ReachesTheWallForceInThePapersTenTicks) {
  ServoSettings settings = wall_at_zero("energy-bounding", 10e3);
  set_parameter(settings.algorithm, "rest_force_step_n", 0.1);
  PositionBench bench(settings);
  bench.move_to(0.0);
  for (int i = 1; i <= 10; ++i) EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 0.1 * i, kNear);
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 1.0, kNear);
}

// A handle that rests is not always at rest in the last digit of its position.
TEST(EnergyBounding, RoundingOfAPositionIsNoMotion) {
  for (const double step_n : {1e6, 0.01}) {
    ServoSettings settings = wall_at_zero("energy-bounding", 35e3);
    set_parameter(settings.algorithm, "rest_force_step_n", step_n);
    PositionBench still(settings);
    PositionBench dithered(settings);
    double dither_m = 1e-18;
    for (const double at_m : {0.0, 1e-4, 1e-4, 1e-4, 1e-4}) {
      dither_m = -dither_m;
      EXPECT_NEAR(dithered.move_to(at_m + dither_m).force_n, still.move_to(at_m).force_n, kNear);
    }
  }
}

TEST(EnergyBounding, StaysFiniteForTheSmallestVelocity) {
  ServoSettings settings = wall_at_zero("energy-bounding", 1e9);
  set_parameter(settings.algorithm, "rest_force_step_n", 0.0);
  PositionBench bench(settings);
  bench.move_to(0.0);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(bench.move_to(std::numeric_limits<double>::denorm_min()).force_n, 0.0, 1e-300);
  }
}

TEST(EnergyBounding2010, RisesByTheHoldsBoundAndFallsByTheStores) {
  PositionBench bench(wall_at_zero("energy-bounding-2010", 1e6));
  bench.move_to(0.0);
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 0.1, kNear);  // c₁ Δx
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 0.1, kNear);  // held
  EXPECT_NEAR(bench.move_to(0.2e-3).force_n, 0.2, kNear);
  // Back by 0.1 mm: what the algorithm gives out comes from its store of F²/2000, and F = (√5 -
  // 1)/10 N is the most for which 2000 F Δx ≥ F² - 0.2².
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, (std::sqrt(5.0) - 1.0) / 10.0, kNear);
}

TEST(EnergyBounding2010, NeverLeavesItsBoundsAlthoughToldMoreThanTheHoldCarries) {
  ServoSettings settings = wall_at_zero("energy-bounding-2010", 1e6);
  set_parameter(settings.algorithm, "storage_stiffness_n_per_m", 1e9);  // validate() refuses it
  PositionBench bench(settings);
  bench.move_to(0.0);
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 0.1, kNear);
}

TEST(ForceBounding, GivesWhatTheWorstNextMoveLeavesPaid) {
  PositionBench bench(wall_at_zero("force-bounding", 1e6));
  bench.move_to(0.0);
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 0.2, kNear);      // E = 0.01 mJ, 2(b/T) Δx
  EXPECT_NEAR(bench.move_to(0.05e-3).force_n, 0.1, kNear);     // E = 0.0025 mJ
  EXPECT_NEAR(bench.move_to(0.05e-3).force_n, 0.1, kNear);     // nothing moved, nothing owed
  EXPECT_NEAR(bench.move_to(0.0 + 1e-12).force_n, 0.0, 1e-7);  // Δx = -F T/(2b): all is spent
}

TEST(HalfSample, PushesHalfAMoveAhead) {
  PositionBench bench(wall_at_zero("half-sample", 10e3));
  bench.move_to(-0.1e-3);
  EXPECT_NEAR(bench.move_to(-0.02e-3).force_n, 0.2, kNear);  // 0.04 mm ahead: inside
  EXPECT_NEAR(bench.move_to(0.08e-3).force_n, 1.3, kNear);
  EXPECT_NEAR(bench.move_to(0.04e-3).force_n, 0.2, kNear);
  EXPECT_EQ(bench.move_to(0.01e-3).force_n, 0.0);
}

TEST(EnergyLimitedSpring, GivesThePassiveSpringOrWhatTheBookAllows) {
  PositionBench bench(wall_at_zero("energy-limited-spring", 10e3));
  bench.move_to(0.0);
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 0.2, kNear);  // nothing put in yet: (2b/T) p
  // 0.2 N through 0.1 mm: 0.02 mJ, which the wall's spring holds at √0.4 N.
  EXPECT_NEAR(bench.move_to(0.2e-3).force_n, std::sqrt(0.4), kNear);
  EXPECT_NEAR(bench.move_to(0.2e-3).force_n, std::sqrt(0.4), kNear);
  // All of it is taken back by 0.03 mm and more: the passive spring is left.
  EXPECT_NEAR(bench.move_to(0.15e-3).force_n, 0.3, kNear);
  EXPECT_EQ(bench.move_to(-0.1e-3).force_n, 0.0);
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 0.2, kNear);  // a new contact, a new book
}

// Paper, section 3.2: b = 1, T = 1 ms gives a coupling of 2 kN/m; in series with the wall.
TEST(VirtualCoupling, IsThePapersTwoKilonewtonsPerMetreInSeries) {
  PositionBench bench(wall_at_zero("virtual-coupling", 35e3));
  EXPECT_NEAR(bench.move_to(1e-3).force_n, 1e-3 * 35e3 * 2e3 / 37e3, kNear);
  EXPECT_EQ(bench.move_to(-1e-3).force_n, 0.0);
}

TEST(VirtualCoupling, WithoutAnyStiffnessThereIsNoForce) {
  ServoSettings settings = wall_at_zero("virtual-coupling", 0.0);
  set_parameter(settings.algorithm, "coupling_stiffness_n_per_m", 0.0);
  EXPECT_EQ(PositionBench(settings).move_to(1e-3).force_n, 0.0);
}

// The handle goes in by 0.1 mm, to 1 N, and out by 0.05 mm under this force: W = -0.05 mJ. The
// damper takes F_d = F_e + W/|Δx| in the direction of motion, or its cap.
TEST(PassivityControl, WithTheHeldForceObserverTakesWhatIsMissingUpToItsCap) {
  for (const auto& [cap, force_n] : {std::pair{1e3, 0.5 - 1.0}, {4.0, 0.5 - 4.0 * 0.05}}) {
    ServoSettings settings = wall_at_zero("passivity-control", 10e3);
    set_parameter(settings.algorithm, "observer", 1.0);
    set_parameter(settings.algorithm, "max_damping_n_s_per_m", cap);
    PositionBench bench(settings);
    bench.move_to(0.0);
    EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 1.0, kNear);
    EXPECT_NEAR(bench.move_to(0.05e-3).force_n, force_n, kNear);
  }
}

TEST(PassivityControl, StaysFiniteForTheSmallestVelocity) {
  ServoSettings settings = wall_at_zero("passivity-control", 1e9);
  set_parameter(settings.algorithm, "observer", 1.0);
  PositionBench bench(settings);
  for (const double position_m : {0.0, 1e-3, 0.5e-3}) bench.move_to(position_m);
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(std::isfinite(bench.move_to(std::nextafter(0.5e-3, 0.0)).force_n));
  }
}

// The follower keeps its own book: two controllers in a row, each with a cap of 1 N·s/m.
// 1 N held through -0.05 mm took 0.05 mJ; 0.5 N through the same again would take 0.025 mJ. With
// 1.5 N less the next move pays both, and nothing is owed.
TEST(PassivityControl, OneStepPaysForWhatTheHoldWillGiveOut) {
  ServoSettings settings = wall_at_zero("passivity-control", 10e3);
  set_parameter(settings.algorithm, "observer", 2.0);
  set_parameter(settings.algorithm, "max_damping_n_s_per_m", 1e6);
  PositionBench bench(settings);
  bench.move_to(0.0);
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 1.0, kNear);
  EXPECT_NEAR(bench.move_to(0.05e-3).force_n, -1.0, kNear);
  const Sample paid = bench.move_to(0.0);
  EXPECT_NEAR(paid.energy_scv_j, 0.0, 1e-15);
  EXPECT_NEAR(paid.force_n, 0.0, kNear);
}

TEST(Follower, HasAStateOfItsOwn) {
  ServoSettings settings = wall_at_zero("passivity-control", 10e3);
  set_parameter(settings.algorithm, "observer", 1.0);
  set_parameter(settings.algorithm, "then", 1.0);
  PositionBench bench(settings);
  bench.move_to(0.0);
  EXPECT_NEAR(bench.move_to(0.1e-3).force_n, 1.0, kNear);
  // 1 N held through -0.05 mm is missing in both books; each takes its 1 N·s/m at 0.05 m/s.
  EXPECT_NEAR(bench.move_to(0.05e-3).force_n, 0.5 - 2.0 * 0.05, kNear);
}

TEST(Follower, BeginsAnewWithTheAlgorithmItFollows) {
  ServoSettings settings = wall_at_zero("none", 10e3);
  settings.transition_s = 0.0;  // a transition of one tick
  set_parameter(settings.algorithm, "observer", 1.0);
  set_parameter(settings.algorithm, "then", 1.0);
  PositionBench bench(settings);
  bench.move_to(0.0);
  bench.move_to(0.1e-3);
  bench.move_to(0.0);  // 0.1 mJ missing
  settings.algorithm.index = find_algorithm("half-sample").value();
  bench.servo().apply(settings);
  bench.move_to(0.0);
  bench.move_to(0.0);  // the blend is over
  // Nothing is owed any more: half a move ahead, undamped.
  EXPECT_NEAR(bench.move_to(0.01e-3).force_n, 0.15, kNear);
}

}  // namespace
}  // namespace hapticwall
