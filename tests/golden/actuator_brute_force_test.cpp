// Tests the path from a command to the handle, its parts alone and all together, against a brute
// force that follows the definition.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "core/plant/plant_model.h"
#include "tests/brute_force_scene.h"

namespace hapticwall {
namespace {

using testing::brute_force_output;
using testing::brute_force_plant;
using testing::BruteForceOutput;
using testing::BruteForcePlant;

// Delay, lag, resolution, friction, grip.
using Parts = std::tuple<bool, bool, bool, bool, bool>;

Scene scene_with(const Parts& parts) {
  const auto [delay, lag, resolution, friction, grip] = parts;
  Scene scene;
  scene.x().device.mass_kg = 0.1;
  scene.x().device.force_limit_n = 3.1;
  scene.x().hand.emplace();
  scene.x().hand->stiffness_n_per_m = 900.0;
  scene.x().hand->damping_n_s_per_m = 5.0;
  scene.x().hand->path = {{0.0, 0.03}, {0.0205, 0.032}, {0.05, 0.0315}};
  if (delay) scene.x().device.delay_ticks = 5;
  if (lag) scene.x().device.amplifier_time_constant_s = 0.0023;
  if (resolution) scene.x().device.force_resolution_n = 0.25;
  if (friction) scene.x().device.friction_n = 0.6;
  if (grip) {
    scene.x().hand->mass_kg = 0.4;
    scene.x().hand->grip_stiffness_n_per_m = 1000.0;
    scene.x().hand->grip_damping_n_s_per_m = 1.0;
  }
  return scene;
}

// Commands as rough as those of a chattering wall, with ties of the resolution and commands at the
// limit.
double command_n(int tick) {
  if (tick % 11 == 0) return 3.1;
  if (tick % 7 == 0) return 0.125 * (1 + 2 * (tick % 5));
  return 2.9 * std::sin(0.37 * tick) + (tick % 5 < 2 ? 0.3 : -0.2);
}

class ActuatorParts : public ::testing::TestWithParam<Parts> {};

TEST_P(ActuatorParts, AreThoseOfTheBruteForce) {
  constexpr int kTicks = 100;
  const bool friction = std::get<3>(GetParam());
  // Without events the brute force is of fourth order and exact to the last digit (a lag of 2.3 ms
  // needs more steps than the hand); with events it is of second order (friction_events_test.cpp).
  const bool lag = std::get<1>(GetParam());
  const int substeps = friction || lag ? 1000 : 100;
  const double tolerance_m = friction ? 1e-11 : 1e-15;
  const double tolerance_j = friction ? 2e-11 : 1e-15;
  const Scene scene = scene_with(GetParam());
  PlantModel plant(scene);
  BruteForcePlant reference = brute_force_plant(scene);
  BruteForceOutput output = brute_force_output(scene);
  for (int tick = 0; tick < kTicks && !HasFailure(); ++tick) {
    plant.advance(command_n(tick));
    reference.advance(output.pass(command_n(tick)), scene.sampling.period_s(), substeps);
    const PlantTruth& truth = plant.truth();
    EXPECT_NEAR(truth.position_m, static_cast<double>(reference.x), tolerance_m) << tick;
    EXPECT_NEAR(truth.actuator_work_j, static_cast<double>(reference.actuator_work), tolerance_j)
        << tick;
    EXPECT_NEAR(truth.dissipation_j, static_cast<double>(reference.dissipation), tolerance_j)
        << tick;
    EXPECT_NEAR(truth.hand_work_j, static_cast<double>(reference.hand_work), tolerance_j) << tick;
  }
  if (friction) EXPECT_GE(reference.events, 6);
}

std::string name_of(const Parts& parts) {
  std::string name = "plain";
  if (std::get<0>(parts)) name += "_delay";
  if (std::get<1>(parts)) name += "_lag";
  if (std::get<2>(parts)) name += "_resolution";
  if (std::get<3>(parts)) name += "_friction";
  if (std::get<4>(parts)) name += "_grip";
  return name;
}

INSTANTIATE_TEST_SUITE_P(Combinations, ActuatorParts,
                         ::testing::Combine(::testing::Bool(), ::testing::Bool(), ::testing::Bool(),
                                            ::testing::Bool(), ::testing::Bool()),
                         [](const auto& param_info) { return name_of(param_info.param); });

}  // namespace
}  // namespace hapticwall
