#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/estimator/position_series.h"

namespace hapticwall {
namespace {

// The response to each displacement by itself, summed.
TEST(LowPass, IsTheConvolutionWithADecayingExponential) {
  constexpr double kCutoffHz = 75.0;
  constexpr double kPeriodS = 0.5e-3;
  const auto positions_m = testing::positions_of(testing::wandering_counts(200), 3e-5);
  const auto found = testing::velocities(
      testing::estimator_scene("low-pass", "cutoff_hz", kCutoffHz), positions_m);
  for (std::size_t k = 0; k < positions_m.size(); ++k) {
    double expected_m_per_s = 0.0;
    for (std::size_t j = 1; j <= k; ++j) {
      const double age_s = static_cast<double>(k - j) * kPeriodS;
      const double left = std::exp(-2.0 * std::numbers::pi * kCutoffHz * age_s);
      const double next = std::exp(-2.0 * std::numbers::pi * kCutoffHz * (age_s + kPeriodS));
      expected_m_per_s += (left - next) * (positions_m[j] - positions_m[j - 1]) / kPeriodS;
    }
    ASSERT_NEAR(found[k], expected_m_per_s, 1e-13) << k;
  }
}

TEST(LowPass, ReachesAStepBy63PercentInItsTimeConstant) {
  const double cutoff_hz = 2000.0 / (2.0 * std::numbers::pi * 40.0);  // 40 ticks
  std::vector<double> positions_m{0.0};
  for (int i = 0; i < 40; ++i) positions_m.push_back(positions_m.back() + 1e-4);
  const Scene scene = testing::estimator_scene("low-pass", "cutoff_hz", cutoff_hz);
  EXPECT_NEAR(testing::velocities(scene, positions_m).back(), 0.2 * (1.0 - std::exp(-1.0)), 1e-12);
}

TEST(LowPass, WithoutAValueIsThatOf30Hertz) {
  const auto positions_m = testing::positions_of(testing::wandering_counts(50), 3e-5);
  EXPECT_EQ(
      testing::velocities(testing::estimator_scene("low-pass", "", 0.0), positions_m),
      testing::velocities(testing::estimator_scene("low-pass", "cutoff_hz", 30.0), positions_m));
}

}  // namespace
}  // namespace hapticwall
