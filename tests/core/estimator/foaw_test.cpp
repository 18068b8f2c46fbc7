#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "tests/core/estimator/position_series.h"

namespace hapticwall {
namespace {

constexpr double kCountM = 20e-6;

Scene foaw_scene(double points, double encoder_m) {
  Scene scene = testing::estimator_scene("foaw", "points", points);
  if (encoder_m > 0.0) scene.x().device.encoder_m = encoder_m;
  return scene;
}

// Whole counts, in which the comparison with one count is exact.
bool line_passes(const std::vector<int>& counts, std::size_t k, int window) {
  const auto back = [&](int ticks) {
    return counts[k] - counts[k - std::min(k, static_cast<std::size_t>(ticks))];
  };
  for (int i = 1; i < window; ++i) {
    if (std::abs(window * back(i) - i * back(window)) > window) return false;
  }
  return true;
}

TEST(Foaw, TakesTheWindowThatWholeCountsAllow) {
  const auto counts = testing::wandering_counts(2000);
  for (const int points : {2, 5, 16, 50}) {
    const auto found =
        testing::velocities(foaw_scene(points, kCountM), testing::positions_of(counts, kCountM));
    std::set<int> windows;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      int window = 1;
      while (window < points && line_passes(counts, k, window + 1)) ++window;
      const std::size_t oldest = k - std::min(k, static_cast<std::size_t>(window));
      const double expected = kCountM * (counts[k] - counts[oldest]) / window * 2000.0;
      ASSERT_NEAR(found[k], expected, 1e-11) << points << " points, tick " << k;
      windows.insert(window);
    }
    if (points == 16) EXPECT_GT(windows.size(), 8U) << "the walk needs windows of many lengths";
  }
}

TEST(Foaw, WithoutCountsIsTheBackwardDifference) {
  const auto positions_m = testing::positions_of(testing::wandering_counts(300), 1.7e-5);
  EXPECT_EQ(
      testing::velocities(foaw_scene(16.0, 0.0), positions_m),
      testing::velocities(testing::estimator_scene("backward-difference", "", 0.0), positions_m));
}

// A turning point lies more than a count beside the line.
TEST(Foaw, ForgetsTheMotionBeforeATurn) {
  std::vector<int> counts;
  for (int k = 0; k <= 20; ++k) counts.push_back(3 * k);
  for (int k = 1; k <= 3; ++k) counts.push_back(60 - 3 * k);
  const auto found =
      testing::velocities(foaw_scene(16.0, kCountM), testing::positions_of(counts, kCountM));
  EXPECT_NEAR(found[20], 3 * kCountM * 2000.0, 1e-12);
  EXPECT_NEAR(found[23], -3 * kCountM * 2000.0, 1e-12);
}

}  // namespace
}  // namespace hapticwall
