// Energy bounding is quiet or swings by centimetres, as the contact begins. The edges between both
// that docs/maps.md quotes, and a program of its own that sees them too: equations of motion by
// brute force in extended precision, the algorithm straight from its formula.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/study/boundary.h"
#include "tests/golden/brute_force_tap.h"

namespace hapticwall {
namespace {

using testing::BruteForcePlant;

constexpr double kSpeedEdge = 0.0371;  // m/s
constexpr double kDampingEdge = 13.3;  // N·s/m
constexpr double kMargin = 0.1;        // relative to an edge
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
  BruteForcePlant plant = testing::tap_plant(speed_m_per_s, hand_damping_n_s_per_m);
  const testing::ReferenceScene controller = testing::paper_controller();
  testing::ReferenceState state;
  double least = 1.0;
  double most = -1.0;
  for (int tick = 0; tick < testing::kPaperTicks; ++tick) {
    if (tick >= testing::kPaperTicks - testing::kPaperTail) {
      least = std::min(least, static_cast<double>(plant.x));
      most = std::max(most, static_cast<double>(plant.x));
    }
    plant.advance(testing::reference_energy_bounding(controller, state, testing::measured_m(plant)),
                  testing::kPaperPeriodS, testing::kPaperSubsteps);
  }
  return most - least;
}

TEST(Attractors, ASlowTapIsQuietAndAFastOneIsNot) {
  const Boundary speed = edge("hand.path_speed_m_per_s", 0.01, 1.0);
  EXPECT_EQ(speed.changes, 1U);
  EXPECT_NEAR(speed.settled.last.value(), kSpeedEdge, kMargin * kSpeedEdge);
  EXPECT_GT(speed.failed.first.value(), *speed.settled.last);
  EXPECT_LE(brute_force_swing_m((1.0 - kMargin) * kSpeedEdge, kTapDamping), 1e-4);
  EXPECT_GT(brute_force_swing_m((1.0 + kMargin) * kSpeedEdge, kTapDamping), 1e-4);
}

TEST(Attractors, AHandWithEnoughDampingIsAlwaysQuiet) {
  const Boundary damping = edge("hand.damping_n_s_per_m", 1.0, 100.0);
  EXPECT_EQ(damping.changes, 1U);
  EXPECT_NEAR(damping.settled.first.value(), kDampingEdge, kMargin * kDampingEdge);
  EXPECT_LT(damping.failed.last.value(), *damping.settled.first);
  EXPECT_GT(brute_force_swing_m(kTapSpeed, (1.0 - kMargin) * kDampingEdge), 1e-4);
  EXPECT_LE(brute_force_swing_m(kTapSpeed, (1.0 + kMargin) * kDampingEdge), 1e-4);
}

}  // namespace
}  // namespace hapticwall
