// Against numbers of programs that share no code with this one.
#include "core/study/worst_hand/damping_criterion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "core/run/simulate.h"
#include "tests/core/study/worst_hand/search_scenes.h"

namespace hapticwall::worst_hand {
namespace {

using hapticwall::testing::ideal_device;
using hapticwall::testing::set_parameter;

DampingCriterion criterion(std::string_view algorithm, double stiffness, double damping) {
  Scene scene = ideal_device(algorithm, 1.0);
  scene.x().walls = {{0.05, stiffness, damping}};
  if (algorithm == "virtual-coupling") set_parameter(scene, "coupling_stiffness_n_per_m", 2200.0);
  return damping_criterion(scene).value();
}

void expect_six_digits(double value, double expected) {
  EXPECT_NEAR(value, expected, 5e-6 * expected);
}

TEST(DampingCriterion, HasTheReferencesToSixDigits) {
  const DampingCriterion none = criterion("none", 2500.0, 0.0);
  expect_six_digits(none.needed_n_s_per_m, 1.25);
  EXPECT_EQ(none.unstable_springs.value().from_n_per_m, 0.0);
  expect_six_digits(none.unstable_springs->to_n_per_m.value(), 128809.9);

  const DampingCriterion damped = criterion("none", 5000.0, 5.0);
  expect_six_digits(damped.needed_n_s_per_m, 7.5);
  expect_six_digits(damped.unstable_springs.value().from_n_per_m, 75234.1);
  EXPECT_FALSE(damped.unstable_springs->to_n_per_m);

  const DampingCriterion half = criterion("half-sample", 5000.0, 0.0);
  expect_six_digits(half.needed_n_s_per_m, 5.0);
  expect_six_digits(half.unstable_springs.value().from_n_per_m, 40778.9);
  EXPECT_FALSE(half.unstable_springs->to_n_per_m);

  const DampingCriterion coupled = criterion("virtual-coupling", 1e9, 0.0);
  expect_six_digits(coupled.needed_n_s_per_m, 1.1);
  EXPECT_EQ(coupled.unstable_springs.value().from_n_per_m, 0.0);
  expect_six_digits(coupled.unstable_springs->to_n_per_m.value(), 54600.2);
}

// A delay of d ticks: (1/2 + d) K T for a spring.
TEST(DampingCriterion, GrowsWithTheDelay) {
  Scene scene = ideal_device("none", 1.0);
  scene.x().walls = {{0.05, 500.0, 0.0}};
  scene.x().device.delay_ticks = 2;
  expect_six_digits(damping_criterion(scene)->needed_n_s_per_m, 1.25);
}

TEST(DampingCriterion, NoSpringIsUnstableWithEnoughDamping) {
  EXPECT_FALSE(criterion("none", 1900.0, 0.0).unstable_springs);
  Scene scene = ideal_device("virtual-coupling", 1.0);
  expect_six_digits(damping_criterion(scene)->needed_n_s_per_m, 2000.0 * 35000.0 / 37000.0 * 5e-4);
  EXPECT_FALSE(damping_criterion(scene)->unstable_springs);
}

// Handle and hand as one mass M with damping b in a wall K: x'' = -(b v + K x_k)/M between ticks.
// Its exact step has a trace and a determinant, and is unstable outside the triangle of Jury.
bool is_unstable(double mass, double stiffness) {
  constexpr double kDamping = 1.0;
  constexpr double kPeriod = 1e-3;
  const double decay = std::exp(-kDamping * kPeriod / mass);
  const double way = mass / kDamping * -std::expm1(-kDamping * kPeriod / mass);  // by 1 m/s
  const double pushed = (kPeriod - way) / kDamping;                              // by 1 N
  const double trace = 1.0 - stiffness * pushed + decay;
  const double determinant = (1.0 - stiffness * pushed) * decay + way * way * stiffness / mass;
  return determinant > 1.0 || std::abs(trace) > 1.0 + determinant;
}

TEST(DampingCriterion, HeavierHandsThanTheCriticalMassAreUnstable) {
  EXPECT_FALSE(criterion("none", 1999.0, 0.0).critical_mass_kg);
  EXPECT_FALSE(criterion("half-sample", 5000.0, 0.0).critical_mass_kg);
  for (const double mass : {1e-6, 1e-4, 1e-2, 1.0, 100.0}) ASSERT_TRUE(is_unstable(mass, 35000.0));
  EXPECT_EQ(criterion("none", 35000.0, 0.0).critical_mass_kg, 0.0);
  for (const double stiffness : {2002.0, 2010.0, 2100.0}) {
    double stable = 1e-3;
    double unstable = 10.0;
    ASSERT_FALSE(is_unstable(stable, stiffness));
    ASSERT_TRUE(is_unstable(unstable, stiffness));
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (stable + unstable);
      (is_unstable(middle, stiffness) ? unstable : stable) = middle;
    }
    const double critical = criterion("none", stiffness, 0.0).critical_mass_kg.value();
    EXPECT_NEAR(critical, unstable, 1e-6 * unstable);
    // b T/(6 (K T/(2 b) - 1)), for K near 2 b/T.
    const double excess = stiffness / 2000.0 - 1.0;
    EXPECT_NEAR(critical, 1e-3 / (6.0 * excess), 1.5 * excess * critical);
  }
}

// The simulation agrees on both sides of the range's end.
TEST(DampingCriterion, TheSimulationOscillatesWithTheseSpringsAlone) {
  const double end = criterion("none", 2500.0, 0.0).unstable_springs->to_n_per_m.value();
  const auto swing_m = [&](double spring) {
    Scene scene = ideal_device("none", 60.0);
    scene.x().device.force_limit_n.reset();
    scene.x().device.start_m = 0.0601;
    scene.x().walls = {{0.05, 2500.0, 0.0}};
    scene.x().hand = HandSettings{};
    scene.x().hand->stiffness_n_per_m = spring;
    scene.x().hand->path = {{0.0, 0.06 + 25.0 / spring}};
    return *simulate(scene).summary.tail_peak_to_peak_m;
  };
  EXPECT_GT(swing_m(0.9 * end), 1e-3);
  EXPECT_LT(swing_m(1.1 * end), 1e-6);
}

TEST(DampingCriterion, IsOfLinearLoopsOnly) {
  EXPECT_FALSE(damping_criterion(ideal_device("energy-bounding", 1.0)));
  EXPECT_FALSE(damping_criterion(hapticwall::testing::tap_device("none", 1.0)));
  Scene two_walls = ideal_device("none", 1.0);
  two_walls.x().walls.push_back({0.06, 1000.0, 0.0});
  EXPECT_FALSE(damping_criterion(two_walls));
}

}  // namespace
}  // namespace hapticwall::worst_hand
