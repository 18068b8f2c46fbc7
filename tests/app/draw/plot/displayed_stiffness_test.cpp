#include "app/draw/plot/displayed_stiffness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "app/draw/plot/sample_history.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/samples.h"

namespace hapticwall::draw {
namespace {

constexpr double kCountM = 0.25e-3;
constexpr double kPeriodS = 1e-3;

// Pushes ticks of a constant penetration and force.
class Touching {
 public:
  double push(int ticks, double penetration_m, double force_n, double count_m = kCountM) {
    double value = 0.0;
    for (int i = 0; i < ticks; ++i) {
      Sample sample;
      sample.time_s = static_cast<double>(tick_++) * kPeriodS;
      sample.penetration_m = penetration_m;
      sample.force_n = force_n;
      value = stiffness_.push(sample, count_m);
    }
    return value;
  }

 private:
  DisplayedStiffness stiffness_;
  std::uint64_t tick_ = 0;
};

TEST(DisplayedStiffness, IsTheQuotientOfMeansAndNotTheMeanOfQuotients) {
  Touching touching;
  touching.push(50, 0.1e-3, 4.0);
  const double value = touching.push(50, 0.3e-3, 6.0);
  EXPECT_NEAR(value, 5.0 / 0.2e-3, 1e-6);
}

TEST(DisplayedStiffness, FreeMotionDoesNotCount) {
  Touching touching;
  touching.push(50, 0.5e-3, 5.0);
  EXPECT_NEAR(touching.push(49, -3.0, 1.0), 1e4, 1e-6);
}

TEST(DisplayedStiffness, IsUnknownUntilThePenetrationHasReachedACount) {
  Touching touching;
  EXPECT_TRUE(std::isnan(touching.push(80, 0.99 * kCountM, 3.0)));
  EXPECT_FALSE(std::isnan(touching.push(1, kCountM, 3.0)));
  EXPECT_FALSE(std::isnan(touching.push(99, 0.5 * kCountM, 3.0)));
  EXPECT_TRUE(std::isnan(touching.push(1, 0.5 * kCountM, 3.0))) << "the count is 100 ms ago";
  EXPECT_FALSE(std::isnan(Touching().push(1, 1e-9, 3.0, 0.0))) << "without an encoder";
}

TEST(DisplayedStiffness, ForgetsAContactAfterTheWindow) {
  Touching touching;
  touching.push(500, 1e-3, 50.0);
  EXPECT_TRUE(std::isnan(touching.push(101, -1e-3, 0.0)));
  EXPECT_EQ(touching.push(1, 1e-3, 1.0), 1e3) << "no residue of the first contact";
}

// The value is that of the summary for a run whose last 100 ms are like its last second.
TEST(DisplayedStiffness, OfAQuietPressIsThatOfTheSummary) {
  Scene scene = file::load_scene("press")->scene;
  scene.algorithm.index = *find_algorithm("energy-bounding");
  const std::vector<Sample> samples = testing::samples_of(scene);
  SampleHistory history(samples.size(), scene.x().device.encoder_m);
  history.push(samples);
  const double shown = history.value(Derived::kStiffness, history.size() - 1);
  const double told = simulate(scene).summary.displayed_stiffness_n_per_m.value();
  EXPECT_NEAR(shown, told, 0.02 * told);
  EXPECT_NEAR(shown, 30.1e3, 1e3);
}

TEST(DisplayedStiffness, StartsAnewWithTheHistory) {
  SampleHistory history(100, kCountM);
  Sample sample;
  sample.tick = 10;
  sample.penetration_m = 1e-3;
  sample.force_n = 7.0;
  history.push(sample);
  sample.tick = 0;
  sample.force_n = 1.0;
  history.push(sample);
  EXPECT_EQ(history.value(Derived::kStiffness, 0), 1e3);
}

}  // namespace
}  // namespace hapticwall::draw
