#include "core/study/normalised_chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace hapticwall {
namespace {

// The published form of the chart has b T/m = 0.02, as the paper's device has here.
TEST(NormalisedChart, OfThePapersDeviceHasThePublishedPeaks) {
  const NormalisedChart chart = chart_of_theory(Scene{});
  EXPECT_DOUBLE_EQ(chart.device_damping, 0.02);
  ASSERT_EQ(chart.delays.size(), 3U);
  constexpr std::array kFirst{0.0401, 0.0134, 0.0081};
  constexpr std::array kBest{0.713, 0.155, 0.069};
  constexpr std::array kBestDamping{0.82, 0.43, 0.29};
  constexpr std::array kLastDamping{2.03, 0.84, 0.55};
  for (std::size_t i = 0; i < chart.delays.size(); ++i) {
    const DelayChart& delay = chart.delays[i];
    EXPECT_EQ(delay.ticks, static_cast<int>(i));
    EXPECT_NEAR(delay.curve.front().limit, kFirst.at(i), 0.5e-4);
    EXPECT_NEAR(delay.best.limit, kBest.at(i), 0.5e-3);
    EXPECT_NEAR(delay.best.damping, kBestDamping.at(i), 0.015);  // the peak is flat
    EXPECT_NEAR(delay.last_damping, kLastDamping.at(i), 0.005);
    EXPECT_LT(delay.curve.back().limit, 1e-6);
    EXPECT_EQ(delay.points.size(), kChartPoints);
    EXPECT_NEAR(delay.curve.front().rule, chart.device_damping / (0.5 + static_cast<double>(i)),
                1e-15);
  }
}

// Settled walls lie below the limit, within 0.1 %; walls that fail lie above it, within the same.
TEST(NormalisedChart, SimulatedPointsLieOnTheirSideOfTheLimit) {
  for (const double damping_n_s_per_m : {0.5, 1.0, 5.0}) {
    Scene scene;
    scene.x().device.damping_n_s_per_m = damping_n_s_per_m;
    NormalisedChart chart = chart_of_theory(scene);
    ASSERT_FALSE(validate(chart));
    ASSERT_TRUE(simulate_points(chart));
    double below = 0.0;
    double above = -1.0;
    for (const DelayChart& delay : chart.delays) {
      for (const SimulatedPoint& point : delay.points) {
        ASSERT_TRUE(point.settled && point.failed);
        EXPECT_EQ(point.changes, 1U);
        below = std::max(below, 1.0 - *point.settled / point.limit);
        above = std::max(above, *point.settled / point.limit - 1.0);
        EXPECT_LE(*point.settled, point.limit);
        EXPECT_GE(*point.settled, point.limit * 0.999);
        EXPECT_GE(*point.failed, point.limit * 0.999);
        EXPECT_LE(*point.failed, point.limit * 1.0002);
      }
    }
    const std::string name = std::to_string(static_cast<int>(10.0 * damping_n_s_per_m));
    RecordProperty("below_" + name, std::to_string(below));
    RecordProperty("above_" + name, std::to_string(above));
  }
}

TEST(NormalisedChart, LeavesOutWhatTheClassicalChartHasNot) {
  Scene scene;
  const NormalisedChart bare = chart_of_theory(scene);
  scene.x().device.friction_n = 1.0;
  scene.x().device.encoder_m = 1e-4;
  scene.x().device.delay_ticks = 5;
  scene.x().device.amplifier_time_constant_s = 1e-3;
  scene.x().hand = HandSettings{};
  scene.x().hand->damping_n_s_per_m = 30.0;
  scene.x().walls = {{0.05, 1000.0, 3.0}};
  EXPECT_EQ(bare_handle(scene), bare.handle);
  // Only m, b and T count, and these as b T/m.
  scene.x().device.mass_kg *= 4.0;
  scene.sampling.rate_hz /= 4.0;
  const NormalisedChart same = chart_of_theory(scene);
  for (std::size_t i = 0; i < bare.delays.size(); ++i) {
    EXPECT_NEAR(same.delays[i].best.limit, bare.delays[i].best.limit, 1e-12);
    EXPECT_NEAR(same.delays[i].last_damping, bare.delays[i].last_damping, 1e-9);
  }
}

TEST(NormalisedChart, WithoutDampingAtAllNoWallIsStable) {
  Scene scene;
  scene.x().device.damping_n_s_per_m = 0.0;
  const NormalisedChart chart = chart_of_theory(scene);
  for (const DelayChart& delay : chart.delays) {
    EXPECT_EQ(delay.curve.front().limit, 0.0);
    EXPECT_GT(delay.best.limit, 0.05);
    EXPECT_EQ(delay.points.front().limit, 0.0);
  }
  EXPECT_FALSE(validate(chart));
}

TEST(NormalisedChart, NamesAStiffnessThatNoSceneHas) {
  Scene scene;
  scene.x().device.mass_kg = 1000.0;
  scene.sampling.rate_hz = 10e3;
  const auto problem = validate(chart_of_theory(scene));
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->key, "wall.stiffness_n_per_m");
}

TEST(NormalisedChart, TellsProgressAndStops) {
  Scene scene;
  scene.x().device.damping_n_s_per_m = 5.0;
  NormalisedChart chart = chart_of_theory(scene);
  double last = 0.0;
  EXPECT_TRUE(simulate_points(chart, {.should_stop = {}, .progress = [&](double fraction) {
                                        EXPECT_GE(fraction, last);
                                        EXPECT_LE(fraction, 1.0);
                                        last = fraction;
                                      }}));
  EXPECT_GT(last, 0.7);
  EXPECT_FALSE(simulate_points(chart, {.should_stop = [] { return true; }, .progress = {}}));
}

}  // namespace
}  // namespace hapticwall
