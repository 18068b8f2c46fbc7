// Scenes whose plant is far stiffer or busier than the sampling: they end in order and in time.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "core/run/simulate.h"
#include "tests/core/run/edge_scene.h"
#include "tests/property/extremes_run.h"

namespace hapticwall {
namespace {

using hapticwall::testing::ended_in_good_order;
using hapticwall::testing::expect_sound;
using hapticwall::testing::ExtremeRun;
using hapticwall::testing::for_each_integrator;
using hapticwall::testing::is_finite;
using hapticwall::testing::pressed;
using hapticwall::testing::run_watched;

// A light handle on a stiff grip swings through the tick a thousand to a million times: states that
// cancel each other must not be added up over all of it.
TEST(Edge, AGripThatSwingsThroughTheTickKeepsTheBalance) {
  for (const double mass_kg : {1e-6, 1.3e-5, 1e-3}) {
    for (const double grip : {1e6, 1.8e8, 1e9}) {
      Scene scene = pressed();
      scene.sampling.rate_hz = 30.65;
      scene.duration_s = 8.0;
      scene.x().walls.clear();
      scene.x().device.mass_kg = mass_kg;
      scene.x().device.damping_n_s_per_m = 2e-6;
      scene.x().hand->mass_kg = 4.83;
      scene.x().hand->stiffness_n_per_m = 3e4;
      scene.x().hand->damping_n_s_per_m = 0.0;
      scene.x().hand->grip_stiffness_n_per_m = grip;
      scene.x().hand->path = {{0.0, 0.02974}};
      (void)expect_sound(scene);
    }
  }
}

// A million ticks in and out of a wall, with all that a device has.
TEST(Edge, AMillionTicksAreSound) {
  constexpr double kTicks = 1e6;
  Scene scene = pressed();
  scene.duration_s = kTicks / scene.sampling.rate_hz;
  scene.x().device.friction_n = 0.14;
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().device.force_limit_n = 8.9;
  scene.x().device.force_resolution_n = 0.01;
  scene.x().device.delay_ticks = 1;
  scene.x().device.amplifier_time_constant_s = 1e-3;
  scene.x().walls.front().stiffness_n_per_m = 20e3;  // chatters
  scene.x().hand->path.edit().resize(1);
  for (int second = 1; second < static_cast<int>(scene.duration_s); ++second) {
    scene.x().hand->path.edit().push_back(
        {static_cast<double>(second), second % 2 == 1 ? 0.06 : 0.04});
  }
  EXPECT_LE(expect_sound(scene), 1e-12);
  EXPECT_GT(simulate(scene).summary.contacts, 10000U);
}

// A wall far beyond what the sampling carries, and no limit: every integrator and the reference
// say so, at a tick, with all that was before it finite.
TEST(Edge, AReallyUnstablePlantIsToldAsDivergedInGoodOrder) {
  Scene scene = pressed();
  scene.x().walls.front().stiffness_n_per_m = 1e9;
  for_each_integrator(scene, [](const Scene& each) {
    const ExtremeRun run = run_watched(each);
    EXPECT_EQ(run.result.summary.verdict, Verdict::kDiverged);
    EXPECT_TRUE(ended_in_good_order(each, run));
    EXPECT_TRUE(run.finite);
    EXPECT_GT(*run.result.summary.diverged_at_tick, 50U);
    EXPECT_LT(*run.result.summary.diverged_at_tick, each.tick_count());
  });
  const SimulationResult reference = simulate_reference(scene);
  EXPECT_EQ(reference.summary.verdict, Verdict::kDiverged);
  EXPECT_EQ(reference.summary.diverged_at_tick, simulate(scene).summary.diverged_at_tick);
  EXPECT_TRUE(is_finite(reference.summary));
}

// ---- a light hand on a stiff grip, with friction: a tick has many starts and stops ----

Scene restless(double hand_kg, double grip_n_per_m, double grip_n_s_per_m) {
  Scene scene = pressed();
  scene.duration_s = 10.0;
  scene.sampling.rate_hz = 228.918;
  scene.x().device.mass_kg = 0.0145;
  scene.x().device.damping_n_s_per_m = 0.02;
  scene.x().device.friction_n = 0.004;
  scene.x().walls.front().stiffness_n_per_m = 41e3;
  scene.x().hand->mass_kg = hand_kg;
  scene.x().hand->stiffness_n_per_m = 7200.0;
  scene.x().hand->damping_n_s_per_m = 21.0;
  scene.x().hand->grip_stiffness_n_per_m = grip_n_per_m;
  scene.x().hand->grip_damping_n_s_per_m = grip_n_s_per_m;
  return scene;
}

TEST(Edge, ATickWithTooManyPiecesIsRefusedInWords) {
  const Scene scene = restless(3.25e-6, 3.18e6, 3700.0);
  ASSERT_FALSE(validate(scene));
  try {
    (void)simulate(scene);
    FAIL() << "the work of a tick has a limit";
  } catch (const SimulationRefused& refused) {
    EXPECT_EQ(std::string(refused.what()).rfind("tick ", 0), 0U) << refused.what();
  }
}

TEST(Edge, ARunWithManyPiecesAsksEarlierWhetherToStop) {
  const Scene scene = restless(1e-5, 1e6, 100.0);
  std::uint64_t questions = 0;
  SimulationOptions options;
  options.should_stop = [&] { return ++questions > 100; };
  (void)simulate(scene, options);
  EXPECT_GT(questions, 10U) << "three for its 2289 ticks if they were quick";
}

}  // namespace
}  // namespace hapticwall
