// Single scenes at the edge of what a scene can name, each with what is known of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/run/simulate.h"
#include "tests/core/run/edge_scene.h"
#include "tests/property/extremes_run.h"
#include "tests/samples.h"

namespace hapticwall {
namespace {

using hapticwall::testing::expect_sound;
using hapticwall::testing::for_each_integrator;
using hapticwall::testing::pressed;
using hapticwall::testing::samples_of;

TEST(Edge, WithoutAHandWhatRestsOnAWallStaysAtRest) {
  Scene scene = pressed();
  scene.x().hand.reset();
  scene.x().device.start_m = scene.x().walls.front().position_m;
  for_each_integrator(scene, [](const Scene& each) {
    (void)expect_sound(each);
    for (const Sample& sample : samples_of(each)) {
      ASSERT_EQ(sample.truth.position_m, each.x().device.start_m);
      ASSERT_EQ(sample.force_n, 0.0);
      ASSERT_EQ(sample.flags & kFlagInContact, 0U);  // a penetration of 0 is no contact
    }
  });
}

TEST(Edge, WithoutAHandWhatStartsInAWallIsThrownOut) {
  Scene scene = pressed();
  scene.x().hand.reset();
  scene.x().device.start_m = 0.06;
  for_each_integrator(scene, [](const Scene& each) {
    (void)expect_sound(each);
    EXPECT_LT(simulate(each).final_state.truth.position_m, 0.05);
  });
}

TEST(Edge, AHandsMassWithoutAGripIsTheHandlesOwn) {
  Scene joined = pressed();
  joined.x().device.mass_kg = 0.0625;
  joined.x().hand->mass_kg = 0.25;
  Scene heavy = pressed();
  heavy.x().device.mass_kg = 0.3125;
  const auto a = samples_of(joined);
  const auto b = samples_of(heavy);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].truth.position_m, b[k].truth.position_m);
    ASSERT_EQ(a[k].truth.kinetic_j, b[k].truth.kinetic_j);
  }
}

TEST(Edge, AGripOfNoStiffnessAndNoDampingLetsTheHandleGo) {
  Scene gripped = pressed();
  gripped.x().device.start_m = 0.055;
  gripped.x().hand->mass_kg = 0.4;
  gripped.x().hand->grip_stiffness_n_per_m = 0.0;
  Scene free = gripped;
  free.x().hand.reset();
  for_each_integrator(gripped, [&](const Scene& each) {
    (void)expect_sound(each);
    free.simulator = each.simulator;
    const SimulationResult held = simulate(each);
    const SimulationResult alone = simulate(free);
    EXPECT_EQ(*held.summary.true_hand_work_j, 0.0);
    EXPECT_NEAR(held.final_state.truth.position_m, alone.final_state.truth.position_m, 1e-15);
    EXPECT_LT(held.final_state.truth.position_m, 0.05);
  });
}

// Handle and hand's spring alone: the swing of a pendulum clock, for ever.
TEST(Edge, WithoutAnyDampingASwingNeitherGrowsNorFades) {
  Scene scene = pressed();
  scene.x().walls.clear();
  scene.duration_s = 100.0;
  scene.x().device.mass_kg = 1.0;
  scene.x().device.damping_n_s_per_m = 0.0;
  scene.x().device.start_m = 0.0;
  scene.x().hand->stiffness_n_per_m = 400.0;
  scene.x().hand->damping_n_s_per_m = 0.0;
  scene.x().hand->path = {{0.0, 0.01}};
  (void)expect_sound(scene);
  constexpr double kRadPerS = 20.0;
  for (const Sample& sample : samples_of(scene)) {
    const double expected_m = 0.01 * (1.0 - std::cos(kRadPerS * sample.time_s));
    ASSERT_NEAR(sample.truth.position_m, expected_m, 1e-13);
  }
}

TEST(Edge, WallsStandAtBothEndsOfTheWorld) {
  for (const double side : {1.0, -1.0}) {
    Scene scene = pressed();
    scene.x().device.start_m = side * 0.999;
    scene.x().walls = {{.position_m = 1.0, .stiffness_n_per_m = 1e4},
                       {.position_m = -1.0, .stiffness_n_per_m = 1e4}};
    scene.x().hand->path = {{0.0, side * 0.999}, {0.1, side}};
    for_each_integrator(scene, [](const Scene& each) { (void)expect_sound(each); });
  }
}

TEST(Edge, OneTickTenHertzAndAHundredKilohertzAreSound) {
  for (const double rate_hz : {10.0, 1000.0, 100e3}) {
    for (const double ticks : {1.0, 2.0, 1000.0}) {
      Scene scene = pressed();
      scene.sampling.rate_hz = rate_hz;
      scene.duration_s = ticks / rate_hz;
      scene.x().hand->path = {{0.0, 0.03}, {scene.duration_s / 2, 0.06}};
      ASSERT_EQ(scene.tick_count(), static_cast<std::uint64_t>(ticks));
      for_each_integrator(scene, [](const Scene& each) { (void)expect_sound(each); });
    }
  }
}

// A hand that moves by the smallest number there is moves the handle by no more.
TEST(Edge, DenormalPathsGiveDenormalMotion) {
  constexpr double kMinDenormal = 5e-324;
  for (const double move_m : {kMinDenormal, 1e-310, 1e-300, -1e-300}) {
    Scene scene = pressed();
    scene.x().device.start_m = 0.0;
    scene.x().walls = {{.position_m = 0.0, .stiffness_n_per_m = 1e3}};
    scene.x().hand->path = {{0.0, 0.0}, {0.1, move_m}, {0.2, 0.0}};
    for_each_integrator(scene, [&](Scene each) {
      for (const bool grip : {false, true}) {
        if (grip) each.x().hand->mass_kg = each.x().hand->grip_stiffness_n_per_m = 1.0;
        (void)expect_sound(each);
        for (const Sample& sample : samples_of(each)) {
          ASSERT_LE(std::abs(sample.truth.position_m), 2.0 * std::abs(move_m));
        }
      }
    });
  }
}

TEST(Edge, EqualPathPointsAndAHandAtRestMoveNothing) {
  Scene scene = pressed();
  scene.x().hand->path = {{0.0, 0.03}, {1e-15, 0.03}, {0.0105, 0.03}, {0.2, 0.03}};
  for (const bool friction : {false, true}) {
    if (friction) scene.x().device.friction_n = 0.14;
    for_each_integrator(scene, [](const Scene& each) {
      (void)expect_sound(each);
      for (const Sample& sample : samples_of(each)) {
        ASSERT_EQ(sample.truth.position_m, 0.03);
        ASSERT_EQ(sample.truth.velocity_m_per_s, 0.0);
      }
    });
  }
}

TEST(Edge, AForceLimitOfZeroIsNoForce) {
  Scene scene = pressed();
  scene.x().device.force_limit_n = 0.0;
  for_each_integrator(scene, [](const Scene& each) {
    (void)expect_sound(each);
    const SimulationResult result = simulate(each);
    EXPECT_EQ(result.summary.peak_force_n, 0.0);
    EXPECT_GT(result.summary.saturated_ticks, 0U);
    EXPECT_EQ(*result.summary.true_actuator_work_j, 0.0);
  });
}

// The limit holds with samples and without, where a faster loop runs.
TEST(Edge, AForceRateLimitsTheRiseAlone) {
  Scene scene = pressed();
  scene.x().walls.front().stiffness_n_per_m = 1e5;
  scene.x().device.max_force_rate_n_per_s = 500.0;
  for_each_integrator(scene, [](Scene each) {
    (void)expect_sound(each);
    double before_n = 0.0;
    double peak_n = 0.0;
    std::size_t flagged = 0;
    for (const Sample& sample : samples_of(each)) {
      ASSERT_LE(std::abs(sample.force_n) - std::abs(before_n), 0.5 + 1e-9) << sample.tick;
      if ((sample.flags & kFlagForceRate) != 0) ++flagged;
      before_n = sample.force_n;
      peak_n = std::max(peak_n, std::abs(before_n));
    }
    EXPECT_GT(flagged, 10U);
    EXPECT_EQ(simulate(each).summary.peak_force_n, peak_n);
    each.x().device.max_force_rate_n_per_s = 0.0;  // none
    EXPECT_GT(simulate(each).summary.peak_force_n, peak_n);
  });
}

// The encoder says 0 where the wall stands a denormal before it: force over penetration is more
// than any number.
TEST(Edge, ADenormalPenetrationGivesAFiniteStiffness) {
  constexpr double kMinDenormal = 5e-324;
  Scene scene = pressed();
  scene.duration_s = 0.2;
  scene.x().device.start_m = -0.01;
  scene.x().device.encoder_m = 1e-3;
  scene.x().device.force_limit_n = 8.9;
  scene.x().walls = {
      {.position_m = -kMinDenormal, .stiffness_n_per_m = 0.0, .damping_n_s_per_m = 100.0}};
  scene.x().hand->path = {{0.0, -0.01}, {0.02, 0.0}};
  for_each_integrator(scene, [](const Scene& each) {
    (void)expect_sound(each);
    double most = 0.0;
    for (const Sample& sample : samples_of(each)) {
      most = std::max(most, sample.stiffness_n_per_m);
    }
    EXPECT_EQ(most, std::numeric_limits<double>::max());
  });
}

// A run that leaves the world in its very last tick says so.
TEST(Edge, WhatDivergesInTheLastTickIsTold) {
  Scene scene = pressed();
  scene.x().hand.reset();
  scene.x().device.start_m = 0.06;
  scene.x().walls.front().stiffness_n_per_m = 1e9;
  scene.duration_s = 1e-3;
  for_each_integrator(scene, [](const Scene& each) {
    (void)expect_sound(each);
    EXPECT_EQ(simulate(each).summary.diverged_at_tick, 1U);
  });
}

// Springs of 1e9 and of 1e-3 N/m on one handle.
TEST(Edge, StiffnessesMayDifferATrillionfold) {
  constexpr double kSoft = 1e-3;
  constexpr double kStiff = 1e9;
  for (const auto& [wall, hand, grip] :
       std::vector<std::array<double, 3>>{{kStiff, kSoft, -1},
                                          {kSoft, kStiff, -1},
                                          {kStiff, kSoft, kStiff},
                                          {kSoft, kStiff, kSoft},
                                          {kSoft, kSoft, kStiff},
                                          {kStiff, kStiff, kSoft}}) {
    Scene scene = pressed();
    scene.x().walls.front().stiffness_n_per_m = wall;
    scene.x().device.force_limit_n = 8.9;
    scene.x().hand->stiffness_n_per_m = hand;
    if (grip >= 0.0) {
      scene.x().hand->mass_kg = 0.4;
      scene.x().hand->grip_stiffness_n_per_m = grip;
    }
    for_each_integrator(scene, [](const Scene& each) { (void)expect_sound(each); });
  }
}

}  // namespace
}  // namespace hapticwall
