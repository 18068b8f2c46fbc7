// Energy bounding is quiet or swings by centimetres, as the contact begins. The edges between both
// that docs/maps.md quotes, and a program of its own that sees them too: equations of motion by
// brute force in extended precision, the algorithm straight from its formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/file/scene/scene_file.h"
#include "core/stabiliser/stabiliser.h"
#include "core/study/boundary.h"
#include "tests/brute_force_plant.h"
#include "tests/reference_algorithms.h"

namespace hapticwall {
namespace {

using testing::BruteForcePlant;
using testing::Real;

constexpr double kSpeedEdge = 0.0371;  // m/s
constexpr double kDampingEdge = 13.3;  // N·s/m
constexpr double kMargin = 0.1;        // of an edge
constexpr double kTapSpeed = 0.2;
constexpr double kTapDamping = 5.0;

Boundary edge(const char* path, double low, double high) {
  BoundaryPlan plan;
  plan.scene = file::load_scene("tap")->scene;
  plan.algorithms = {find_algorithm("energy-bounding").value()};
  plan.along = {find_scene_number(plan.scene, path).value(), low, high, 41, true};
  return find_boundaries(plan).front();
}

// Peak to peak of the last of six seconds, metres.
double brute_force_swing_m(double speed_m_per_s, double hand_damping_n_s_per_m) {
  constexpr double kPeriodS = 1e-3;
  constexpr double kCountM = 0.254e-3;
  constexpr int kTicks = 6000;
  constexpr int kTail = 1000;
  constexpr int kSubsteps = 100;
  BruteForcePlant plant;
  plant.mass = 0.05L;
  plant.damping = 1.0L;
  plant.friction = 0.14L;
  plant.x = plant.y = 0.03L;
  plant.hand_mass = 0.2L;
  plant.hand_stiffness = 300.0L;
  plant.hand_damping = hand_damping_n_s_per_m;
  plant.grip_stiffness = 2000.0L;
  plant.grip_damping = 2.0L;
  const Real rate = speed_m_per_s;
  const Real arrival = 0.0353L / rate;
  plant.path = [=](Real t, Real inside) { return inside < arrival ? 0.03L + rate * t : 0.0653L; };
  plant.path_velocity = [=](Real inside) { return inside < arrival ? rate : 0.0L; };
  testing::ReferenceScene controller;
  controller.rate = 1.0 / kPeriodS;
  controller.b = 1.0;
  controller.limit = 8.9;
  controller.walls = {{0.05, 35e3, 0.0}};
  controller.alpha_rest = 0.01;
  testing::ReferenceState state;
  double least = 1.0;
  double most = -1.0;
  for (int tick = 0; tick < kTicks; ++tick) {
    if (tick >= kTicks - kTail) {
      least = std::min(least, static_cast<double>(plant.x));
      most = std::max(most, static_cast<double>(plant.x));
    }
    const double measured = kCountM * std::rint(static_cast<double>(plant.x) / kCountM);
    plant.advance(testing::reference_energy_bounding(controller, state, measured), kPeriodS,
                  kSubsteps);
  }
  return most - least;
}

TEST(Attractors, ASlowTapIsQuietAndAFastOneIsNot) {
  const Boundary speed = edge("hand.path_speed_m_per_s", 0.01, 1.0);
  EXPECT_EQ(speed.changes, 1U);
  EXPECT_NEAR(speed.settled.value(), kSpeedEdge, kMargin * kSpeedEdge);
  EXPECT_GT(speed.unsettled.value(), *speed.settled);
  EXPECT_LE(brute_force_swing_m((1.0 - kMargin) * kSpeedEdge, kTapDamping), 1e-4);
  EXPECT_GT(brute_force_swing_m((1.0 + kMargin) * kSpeedEdge, kTapDamping), 1e-4);
}

TEST(Attractors, OfADampedHandThereIsOnlyTheQuietOne) {
  const Boundary damping = edge("hand.damping_n_s_per_m", 1.0, 100.0);
  EXPECT_EQ(damping.changes, 1U);
  EXPECT_NEAR(damping.settled.value(), kDampingEdge, kMargin * kDampingEdge);
  EXPECT_LT(damping.unsettled.value(), *damping.settled);
  EXPECT_GT(brute_force_swing_m(kTapSpeed, (1.0 - kMargin) * kDampingEdge), 1e-4);
  EXPECT_LE(brute_force_swing_m(kTapSpeed, (1.0 + kMargin) * kDampingEdge), 1e-4);
}

}  // namespace
}  // namespace hapticwall
