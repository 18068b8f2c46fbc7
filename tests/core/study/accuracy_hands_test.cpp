// How many hands an integrator renders right: against single runs, and on a scene without friction,
// where the fourth-order method is right with every hand and the first-order one misses the cycle.
#include "core/study/accuracy_hands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"

namespace hapticwall {
namespace {

// The golden-hard scene, for 2 s.
AccuracyHandsPlan chatter_of_hands() {
  AccuracyHandsPlan plan;
  plan.scene.duration_s = 2.0;
  plan.scene.x().device.mass_kg = 0.1;
  plan.scene.x().device.force_limit_n = 8.9;
  HandSettings hand;
  hand.mass_kg = 0.1;
  hand.stiffness_n_per_m = 300.0;
  hand.damping_n_s_per_m = 5.0;
  hand.path = {{0.0, 0.03}, {0.3, 0.06}};
  plan.scene.x().hand = hand;
  plan.scene.x().walls = {{0.05, 35'000.0, 0.0}};
  plan.scene.algorithm.index = *find_algorithm("none");
  plan.substeps = {1, 10};
  plan.hands = 5;
  return plan;
}

TEST(AccuracyHands, TheHandsDifferByFivePerCent) {
  EXPECT_EQ(hand_stiffness(200.0, 0, 21), 190.0);
  EXPECT_EQ(hand_stiffness(200.0, 10, 21), 200.0);
  EXPECT_EQ(hand_stiffness(200.0, 20, 21), 210.0);
  EXPECT_NEAR(hand_stiffness(200.0, 1, 21), 191.0, 1e-9);
}

TEST(AccuracyHands, CountsTheRightOnes) {
  const auto measured = measure_hands(chatter_of_hands());
  ASSERT_TRUE(measured);
  EXPECT_EQ(measured->exact.size(), 5U);
  EXPECT_EQ(measured->oscillating(), 5U);
  ASSERT_EQ(measured->rows.size(), 4U);
  EXPECT_EQ(measured->rows[0].compared, 5U);
  EXPECT_EQ(measured->rows[0].within, 0U) << "one semi-implicit step hides the cycle";
  EXPECT_EQ(measured->rows[0].verdicts_agree, 0U);
  EXPECT_NEAR(*measured->rows[0].max_error, 1.0, 1e-3);
  EXPECT_EQ(measured->rows[3].integrator, Integrator::kRungeKutta4);
  EXPECT_EQ(measured->rows[3].substeps, 10);
  EXPECT_EQ(measured->rows[3].within, 5U);
  EXPECT_EQ(measured->rows[3].verdicts_agree, 5U);
  EXPECT_LT(*measured->rows[3].max_error, 1e-3);
}

TEST(AccuracyHands, EqualsSingleRuns) {
  const AccuracyHandsPlan plan = chatter_of_hands();
  const auto measured = measure_hands(plan, {.threads = 1, .should_stop = {}, .progress = {}});
  ASSERT_TRUE(measured);
  double max_error = 0.0;
  for (std::size_t i = 0; i < plan.hands; ++i) {
    Scene scene = plan.scene;
    scene.x().hand->stiffness_n_per_m = 285.0 + 7.5 * static_cast<double>(i);
    const double exact_m = *simulate(scene).summary.tail_peak_to_peak_m;
    EXPECT_EQ(measured->exact[i].tail_peak_to_peak_m, exact_m);
    scene.simulator = {Integrator::kSemiImplicitEuler, 10};
    const double stepped_m = *simulate(scene).summary.tail_peak_to_peak_m;
    max_error = std::max(max_error, std::abs(stepped_m / exact_m - 1.0));
  }
  EXPECT_EQ(*measured->rows[1].max_error, max_error);
}

TEST(AccuracyHands, TakesAHandWithAStiffness) {
  AccuracyHandsPlan plan = chatter_of_hands();
  EXPECT_FALSE(validate(plan));
  plan.scene.x().hand->stiffness_n_per_m = 0.0;
  EXPECT_TRUE(validate(plan));
  plan.scene.x().hand.reset();
  EXPECT_TRUE(validate(plan));
}

TEST(AccuracyHands, CanBeEnded) {
  EXPECT_FALSE(measure_hands(chatter_of_hands(),
                             {.threads = 1, .should_stop = [] { return true; }, .progress = {}}));
}

}  // namespace
}  // namespace hapticwall
