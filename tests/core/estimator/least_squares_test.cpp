#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/estimator/position_series.h"

namespace hapticwall {
namespace {

// Before the first tick the handle counts as at rest.
double position_at(const std::vector<double>& positions_m, std::size_t k, std::size_t age) {
  return positions_m[k - std::min(k, age)];
}

TEST(LeastSquares, IsTheSlopeByTheNormalEquations) {
  const auto positions_m = testing::positions_of(testing::wandering_counts(200), 3e-5);
  for (const int points : {2, 3, 7, 16, 50}) {
    const auto found = testing::velocities(
        testing::estimator_scene("least-squares", "points", points), positions_m);
    for (std::size_t k = 0; k < positions_m.size(); ++k) {
      double t = 0.0;
      double x = 0.0;
      double tt = 0.0;
      double tx = 0.0;
      for (int i = 0; i < points; ++i) {
        const double time_s = -0.5e-3 * i;
        const double position_m = position_at(positions_m, k, static_cast<std::size_t>(i));
        t += time_s;
        x += position_m;
        tt += time_s * time_s;
        tx += time_s * position_m;
      }
      ASSERT_NEAR(found[k], (points * tx - t * x) / (points * tt - t * t), 1e-11)
          << points << " points, tick " << k;
    }
  }
}

TEST(LeastSquares, OfAParabolaIsTheVelocityInTheMiddleOfItsWindow) {
  std::vector<double> positions_m;
  for (int k = 0; k < 60; ++k) positions_m.push_back(1e-6 * k * k);
  const Scene scene = testing::estimator_scene("least-squares", "points", 9.0);
  EXPECT_NEAR(testing::velocities(scene, positions_m).back(), 2e-6 * (59 - 4) * 2000.0, 1e-12);
}

}  // namespace
}  // namespace hapticwall
