// Axes that need each other at every tick.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "core/environment/environment.h"
#include "core/run/simulate.h"
#include "core/scene_keys.h"
#include "tests/position_bench.h"

namespace hapticwall {
namespace {

AxisSettings axis_from(double start_m, std::vector<PathPoint> path) {
  AxisSettings axis;
  axis.device.mass_kg = 0.05;
  axis.device.damping_n_s_per_m = 1.0;
  axis.device.friction_n = 0.1;
  axis.device.encoder_m = 2e-5;
  axis.device.start_m = start_m;
  HandSettings& hand = axis.hand.emplace();
  hand.stiffness_n_per_m = 300.0;
  hand.damping_n_s_per_m = 5.0;
  hand.path = SharedPath(std::move(path));
  return axis;
}

Scene scene_of(std::string_view environment, std::string_view algorithm) {
  Scene scene;
  scene.duration_s = 1.5;
  scene.axes = {axis_from(0.03, {{0.0, 0.03}, {1.2, 0.07}}),
                axis_from(0.045, {{0.0, 0.045}, {0.5, 0.045}, {1.0, 0.06}})};
  scene.environment.index = find_environment(environment).value();
  scene.algorithm.index = find_algorithm(algorithm).value();
  return scene;
}

void set_form(Scene& scene, double form) { testing::set_parameter(scene.algorithm, "form", form); }

std::vector<Tick> ticks_of(const Scene& scene, AxesResult* result = nullptr) {
  std::vector<Tick> ticks;
  AxesOptions options;
  options.on_tick = [&](const Tick& tick) { ticks.push_back(tick); };
  const AxesResult run = simulate_axes(scene, options);
  if (result != nullptr) *result = run;
  return ticks;
}

// Tissue is the same on each axis by itself: ticking together must change no bit.
TEST(CoupledAxes, EachAxisIsThatOfItsOwnRun) {
  for (const char* algorithm : {"none", "energy-bounding", "half-sample", "virtual-coupling"}) {
    Scene scene = scene_of("hunt-crossley", algorithm);
    scene.sampling.render_every = 2;
    ASSERT_FALSE(validate(scene));
    ASSERT_TRUE(couples_axes(scene));
    AxesResult together;
    const std::vector<Tick> ticks = ticks_of(scene, &together);
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<Sample> alone;
      SimulationOptions options;
      options.on_sample = [&](const Sample& sample) { alone.push_back(sample); };
      const Summary summary = simulate(axis_scene(scene, i), options).summary;
      ASSERT_EQ(ticks.size(), alone.size());
      for (std::size_t k = 0; k < alone.size(); ++k) {
        ASSERT_EQ(ticks[k].axes.at(i).force_n, alone[k].force_n) << k;
        ASSERT_EQ(ticks[k].axes.at(i).truth.position_m, alone[k].truth.position_m) << k;
        ASSERT_EQ(ticks[k].axes.at(i).velocity_m_per_s, alone[k].velocity_m_per_s) << k;
      }
      EXPECT_EQ(together.axes.at(i).summary.peak_force_n, summary.peak_force_n);
      EXPECT_EQ(together.axes.at(i).summary.displayed_stiffness_n_per_m,
                summary.displayed_stiffness_n_per_m);
      EXPECT_EQ(together.axes.at(i).summary.verdict, summary.verdict);
    }
  }
}

// A H/σ² e^{-r²/2σ²} of both positions of the same tick.
TEST(CoupledAxes, ABumpKnowsBothPositionsOfTheTick) {
  for (const Tick& tick : ticks_of(scene_of("bump", "none"))) {
    const double x = (tick.axes[0].position_m - 0.05) / 0.008;
    const double y = (tick.axes[1].position_m - 0.05) / 0.008;
    const double slope_n = -10.0 * 0.005 / 0.008 * std::exp(-0.5 * (x * x + y * y));
    ASSERT_NEAR(tick.axes[0].wall_force_n, slope_n * x, 1e-12);
    ASSERT_NEAR(tick.axes[1].wall_force_n, slope_n * y, 1e-12);
  }
}

constexpr double kDamping = 0.2;  // b, N·s/m

struct ForceChange {
  double length_n = 0.0;
  double bound_n = 0.0;
  double off_direction = 0.0;  // sine of the angle to the change that was wanted
};

ForceChange change_at(const Tick& before, const Tick& now) {
  std::array<double, 2> got{};
  std::array<double, 2> wanted{};
  double speed = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    got.at(i) = now.axes.at(i).force_n - before.axes.at(i).force_n;
    wanted.at(i) = now.axes.at(i).wall_force_n - before.axes.at(i).force_n;
    speed = std::hypot(speed, now.axes.at(i).velocity_m_per_s);
  }
  const double length = std::hypot(got[0], got[1]);
  const double cross = got[0] * wanted[1] - got[1] * wanted[0];
  const double product = length * std::hypot(wanted[0], wanted[1]);
  return {length, kDamping * speed, product > 0.0 ? std::abs(cross) / product : 0.0};
}

// A hill of 1.6 kN/m, whose force changes by more than b v in a tick. b of axis x is kDamping.
Scene steep_scene(double damping_y_n_s_per_m) {
  Scene scene = scene_of("bump", "energy-bounding");
  for (AxisSettings& axis : scene.axes) axis.device.encoder_m = 0.0;
  scene.axes[0].device.damping_n_s_per_m = kDamping;
  scene.axes[1].device.damping_n_s_per_m = damping_y_n_s_per_m;
  find_scene_number(scene, "environment.weight_n").value().set(scene, 20.0);
  set_form(scene, 1.0);
  return scene;
}

// The smaller damping of both axes is that of the bound.
TEST(CoupledAxes, TheVectorFormBoundsTheVectorAndKeepsItsDirection) {
  for (const double damping_y_n_s_per_m : {kDamping, 5.0 * kDamping}) {
    const std::vector<Tick> ticks = ticks_of(steep_scene(damping_y_n_s_per_m));
    int at_the_bound = 0;
    for (std::size_t k = 1; k < ticks.size(); ++k) {
      const ForceChange change = change_at(ticks[k - 1], ticks[k]);
      if (change.bound_n == 0.0) continue;
      ASSERT_LE(change.length_n, change.bound_n * (1.0 + 1e-9)) << k;
      ASSERT_LE(change.off_direction, 1e-6) << k;
      at_the_bound += change.length_n > 0.999 * change.bound_n ? 1 : 0;
      const double hold_j = ticks[k].axes[0].energy_hold_j + ticks[k].axes[1].energy_hold_j;
      const double budget_j = ticks[k].axes[0].energy_budget_j + ticks[k].axes[1].energy_budget_j;
      ASSERT_GE(hold_j, budget_j - 1e-12) << k;
    }
    EXPECT_GT(at_the_bound, 20) << damping_y_n_s_per_m;
  }
}

TEST(CoupledAxes, HalfSampleLooksAheadOnBoth) {
  Scene scene = scene_of("bump", "half-sample");
  for (AxisSettings& axis : scene.axes) axis.device.encoder_m = 0.0;
  double moved_by = 0.0;
  for (const Tick& tick : ticks_of(scene)) {
    std::array<double, 2> away{};  // half a tick later, in widths from the top
    for (std::size_t i = 0; i < 2; ++i) {
      const Sample& sample = tick.axes.at(i);
      away.at(i) = (sample.position_m + 0.5e-3 * sample.velocity_m_per_s - 0.05) / 0.008;
    }
    const double slope_n =
        -10.0 * 0.005 / 0.008 * std::exp(-0.5 * (away[0] * away[0] + away[1] * away[1]));
    ASSERT_NEAR(tick.axes[0].force_n, slope_n * away[0], 1e-12);
    ASSERT_NEAR(tick.axes[1].force_n, slope_n * away[1], 1e-12);
    moved_by = std::max(moved_by, std::abs(tick.axes[0].force_n - tick.axes[0].wall_force_n));
  }
  EXPECT_GT(moved_by, 1e-3);
}

TEST(CoupledAxes, TheVectorFormCouplesWallsToo) {
  Scene scene = scene_of("walls", "energy-bounding");
  for (AxisSettings& axis : scene.axes)
    axis.walls = {{.position_m = 0.05, .stiffness_n_per_m = 1e4}};
  EXPECT_FALSE(couples_axes(scene));
  const std::vector<Tick> apart = ticks_of(scene);
  set_form(scene, 1.0);
  ASSERT_TRUE(couples_axes(scene));
  const std::vector<Tick> together = ticks_of(scene);
  bool differs = false;
  for (std::size_t k = 0; k < apart.size(); ++k)
    differs = differs || apart[k].axes[0].force_n != together[k].axes[0].force_n;
  EXPECT_TRUE(differs);
}

TEST(CoupledAxes, OnOneAxisBothFormsAreTheSame) {
  Scene scene = axis_scene(scene_of("bump", "energy-bounding"), 0);
  const Summary per_axis = simulate(scene).summary;
  set_form(scene, 1.0);
  const Summary vector = simulate(scene).summary;
  EXPECT_EQ(per_axis.peak_force_n, vector.peak_force_n);
  EXPECT_EQ(per_axis.max_penetration_m, vector.max_penetration_m);
}

TEST(CoupledAxes, AChangeCouplesThemFromItsTickOn) {
  Scene scene = scene_of("hunt-crossley", "energy-bounding");
  scene.environment = {};
  Scene later = scene_of("hunt-crossley", "energy-bounding");
  const std::vector<ScheduledChange> changes{{700, later}};
  std::vector<Tick> ticks;
  AxesOptions options;
  options.on_tick = [&](const Tick& tick) { ticks.push_back(tick); };
  options.changes = changes;
  (void)simulate_axes(scene, options);
  ASSERT_EQ(ticks.size(), scene.tick_count());
  double before_n = 0.0;
  double after_n = 0.0;
  for (const Tick& tick : ticks) {
    double& peak_n = tick.x().tick < 700 ? before_n : after_n;
    peak_n = std::max(peak_n, tick.x().wall_force_n);
  }
  EXPECT_EQ(before_n, 0.0);
  EXPECT_GT(after_n, 0.5);
}

}  // namespace
}  // namespace hapticwall
