#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/estimator/position_series.h"

namespace hapticwall {
namespace {

// The differentiator in absolute positions.
std::vector<double> by_definition(const std::vector<double>& positions_m, double gain) {
  constexpr double kStepS = 0.5e-3 / 20.0;
  double z = positions_m.front();
  double w = 0.0;
  std::vector<double> found;
  for (const double x : positions_m) {
    for (int i = 0; i < 20; ++i) {
      const double sign = z > x ? 1.0 : z < x ? -1.0 : 0.0;
      const double rate = w - 1.5 * std::sqrt(gain) * std::sqrt(std::abs(z - x)) * sign;
      w -= kStepS * 1.1 * gain * sign;
      z += kStepS * rate;
    }
    found.push_back(w);
  }
  return found;
}

// Rounding may turn a sign one step earlier; a step is worth λ0 T/20.
TEST(Levant, IsTheSlidingModeInTwentyStepsATick) {
  for (const double gain : {2.0, 10.0, 50.0}) {
    std::vector<double> positions_m;
    for (int k = 0; k < 3000; ++k) positions_m.push_back(0.004 * std::sin(0.01 * k) + 1e-6 * k);
    const auto found =
        testing::velocities(testing::estimator_scene("levant", "gain", gain), positions_m);
    const auto expected = by_definition(positions_m, gain);
    double largest = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k)
      largest = std::max(largest, std::abs(found[k] - expected[k]));
    EXPECT_LT(largest, 2.0 * 1.1 * gain * 0.5e-3 / 20.0) << gain;
    EXPECT_GT(*std::ranges::max_element(found), 0.05) << gain;
  }
}

// The acceleration is 4 m/s². A gain above it follows, one below it does not.
TEST(Levant, FollowsAnAccelerationBelowItsGainOnly) {
  std::vector<double> positions_m;
  for (int k = 0; k < 2000; ++k) positions_m.push_back(2.0 * (0.5e-3 * k) * (0.5e-3 * k));
  const double velocity_m_per_s = 4.0 * 0.5e-3 * 1999;
  const auto last = [&](double gain) {
    return testing::velocities(testing::estimator_scene("levant", "gain", gain), positions_m)
        .back();
  };
  EXPECT_NEAR(last(10.0), velocity_m_per_s, 0.1) << "a position stays for 20 steps";
  EXPECT_LT(last(2.0), velocity_m_per_s - 1.0);
}

}  // namespace
}  // namespace hapticwall
