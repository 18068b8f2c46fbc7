#include "core/study/stability_bounds.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "core/algorithm/algorithm.h"

namespace hapticwall {
namespace {

Scene papers_device() {
  Scene scene;
  scene.sampling.rate_hz = 1000.0;
  scene.x().device.damping_n_s_per_m = 1.0;
  return scene;
}

TEST(StabilityBounds, AreThoseOfThePapersDevice) {
  Scene scene = papers_device();
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().device.force_limit_n = 8.9;
  scene.x().device.friction_n = 0.14;
  const StabilityBounds bounds = stability_bounds(scene, {}, {});
  EXPECT_DOUBLE_EQ(*bounds.passive_n_per_m, 2000.0);
  EXPECT_DOUBLE_EQ(*bounds.rule_n_per_m, 2000.0);
  EXPECT_NEAR(*bounds.friction_n_per_m, 1102.4, 0.1);
  EXPECT_NEAR(*bounds.resolution_n_per_m, 35039.4, 0.1);
}

// A whole tick of delay leaves a third of the stiffness.
TEST(StabilityBounds, FallWithTheDelay) {
  EXPECT_NEAR(*stability_bounds(papers_device(), {}, {.transport_s = 1e-3, .time_constant_s = 0.0})
                   .rule_n_per_m,
              2000.0 / 3.0, 1e-9);
}

TEST(StabilityBounds, WallDampingTakesFromPassivityAndAddsToTheOther) {
  WallSettings wall;
  wall.damping_n_s_per_m = 0.25;
  const StabilityBounds bounds = stability_bounds(papers_device(), wall, {});
  EXPECT_DOUBLE_EQ(*bounds.passive_n_per_m, 1500.0);
  EXPECT_DOUBLE_EQ(*bounds.rule_n_per_m, 2500.0);
  wall.damping_n_s_per_m = 3.0;
  EXPECT_DOUBLE_EQ(*stability_bounds(papers_device(), wall, {}).passive_n_per_m, 0.0);
}

TEST(StabilityBounds, NothingLimitsWhatTheSceneDoesNotName) {
  Scene scene = papers_device();
  EXPECT_FALSE(stability_bounds(scene, {}, {}).friction_n_per_m);
  EXPECT_FALSE(stability_bounds(scene, {}, {}).resolution_n_per_m);
  scene.x().device.encoder_m = 0.0;
  scene.x().device.force_limit_n = 8.9;
  EXPECT_FALSE(stability_bounds(scene, {}, {}).resolution_n_per_m);
}

TEST(StabilityBounds, DelayOfASimulatedDeviceIsItsTicksAndItsLag) {
  Scene scene = papers_device();
  EXPECT_DOUBLE_EQ(delay_of(scene).total_s(), 0.0);
  scene.x().device.delay_ticks = 2;
  scene.x().device.amplifier_time_constant_s = 0.5e-3;
  EXPECT_DOUBLE_EQ(delay_of(scene).transport_s, 2e-3);
  EXPECT_DOUBLE_EQ(delay_of(scene).total_s(), 2.5e-3);
}

// Its value is tested in tests/golden/stable_limit_test.cpp.
TEST(StabilityBounds, TheStableLimitKnowsHandDelayLagAndDamping) {
  Scene scene = papers_device();
  const auto limit = [&](double damping) {
    const WallSettings wall{0.05, 0.0, damping};
    return *stability_bounds(scene, wall, delay_of(scene)).stable_n_per_m;
  };
  const double alone = limit(0.0);
  EXPECT_NEAR(alone, 2006.69, 0.01);
  EXPECT_GT(limit(1.0), alone);
  EXPECT_EQ(limit(110.0), 0.0) << "the softest walls are unstable with so much damping";
  scene.x().hand = HandSettings{};
  scene.x().hand->damping_n_s_per_m = 1.0;
  EXPECT_NEAR(limit(0.0), 2.0 * alone, 0.02 * alone);
  const double held = limit(0.0);
  scene.x().device.amplifier_time_constant_s = 0.5e-3;
  const double with_lag = limit(0.0);
  EXPECT_LT(with_lag, 0.6 * held);
  scene.x().device.delay_ticks = 1;
  EXPECT_LT(limit(0.0), 0.6 * with_lag);
}

// A force limit acts on large swings only. Every other part makes the loop another one.
TEST(StabilityBounds, TheExactLimitIsThatOfALinearLoopWithOneWall) {
  Scene linear = papers_device();
  linear.x().walls = {{0.05, 1000.0, 0.0}};
  linear.x().device.force_limit_n = 8.9;
  linear.x().device.delay_ticks = 1;
  const auto limit = exact_stable_limit(linear);
  ASSERT_TRUE(limit);
  EXPECT_EQ(limit, stability_bounds(linear, linear.x().walls[0], delay_of(linear)).stable_n_per_m);
  const std::vector<std::function<void(Scene&)>> changes{
      [](Scene& s) { s.x().walls.clear(); },
      [](Scene& s) {
        s.x().walls.push_back({0.06, 500.0, 0.0});
      },
      [](Scene& s) { s.x().device.friction_n = 0.1; },
      [](Scene& s) { s.x().device.encoder_m = 1e-5; },
      [](Scene& s) { s.x().device.force_resolution_n = 0.01; },
      [](Scene& s) { s.simulator.integrator = Integrator::kRungeKutta4; },
      [](Scene& s) { s.algorithm.values.at(*find_algorithm_parameter("then")) = 1.0; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene changed = linear;
    changes[i](changed);
    EXPECT_FALSE(exact_stable_limit(changed)) << i;
  }
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    linear.algorithm.index = i;
    EXPECT_EQ(exact_stable_limit(linear).has_value(), algorithms()[i].name == "none");
  }
}

}  // namespace
}  // namespace hapticwall
