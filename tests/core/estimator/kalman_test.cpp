#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>

#include "tests/core/estimator/position_series.h"

namespace hapticwall {
namespace {

// The filter in matrices and SI units, with the gains that a long run of its Riccati equation
// gives.
struct MatrixFilter {
  MatrixFilter(double ratio, double period_s) {
    const double t = period_s;
    const double density = ratio / (t * t * t);  // of the acceleration, for a variance of 1
    transition << 1.0, t, 0.0, 1.0;
    noise << t * t * t / 3.0, t * t / 2.0, t * t / 2.0, t;
    noise *= density;
    Eigen::Matrix2d covariance = noise;
    for (int i = 0; i < 200000; ++i) {
      gains = covariance.col(0) / (covariance(0, 0) + 1.0);
      const Eigen::Matrix2d corrected = covariance - gains * covariance.row(0);
      covariance = transition * corrected * transition.transpose() + noise;
    }
  }

  Eigen::Matrix2d transition;
  Eigen::Matrix2d noise;
  Eigen::Vector2d gains;
};

TEST(Kalman, IsTheSteadyFilterOfItsRiccatiEquation) {
  const auto positions_m = testing::positions_of(testing::wandering_counts(300), 3e-5);
  for (const double ratio : {1e-6, 0.1, 20.0, 1000.0}) {
    const MatrixFilter filter(ratio, 0.5e-3);
    Eigen::Vector2d state(positions_m.front(), 0.0);
    const auto found =
        testing::velocities(testing::estimator_scene("kalman", "noise_ratio", ratio), positions_m);
    for (std::size_t k = 0; k < positions_m.size(); ++k) {
      const Eigen::Vector2d predicted = filter.transition * state;
      state = predicted + filter.gains * (positions_m[k] - predicted[0]);
      ASSERT_NEAR(found[k], state[1], 1e-8) << ratio << ", tick " << k;
    }
  }
}

TEST(Kalman, ShowsTheGainsOfARatio) {
  const Scene scene = testing::estimator_scene("kalman", "noise_ratio", 0.1);
  const Estimator& kalman = *chosen_estimator(scene.estimator);
  const DerivedNumbers numbers = kalman.numbers({1000.0, 0.0, &scene.estimator});
  EXPECT_NEAR(numbers[0].value, 0.548528, 5e-7);
  EXPECT_NEAR(numbers[1].value, 212.479, 5e-4);
  EXPECT_EQ(numbers[1].unit, "/s");
}

}  // namespace
}  // namespace hapticwall
