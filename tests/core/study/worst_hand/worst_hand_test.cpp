#include "core/study/worst_hand/worst_hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/run/simulate.h"
#include "tests/core/study/worst_hand/search_scenes.h"

namespace hapticwall::worst_hand {
namespace {

using hapticwall::testing::ideal_device;
using hapticwall::testing::set_parameter;
using hapticwall::testing::tap_device;

Found found(const Plan& plan, int threads = 0) {
  std::optional<Found> result =
      search(plan, {.threads = threads, .should_stop = {}, .time_is_up = {}, .progress = {}});
  EXPECT_TRUE(result);
  return std::move(*result);
}

TEST(WorstHand, IsTheSameOnOneThreadAndOnTwo) {
  const Plan plan{tap_device("none", 0.3), 1300, 3, Bounds::kWide};
  const Found one = found(plan, 1);
  const Found two = found(plan, 2);
  EXPECT_EQ(one.hands, 1300U);
  EXPECT_EQ(one.first(), two.first());
  EXPECT_EQ(one.most_j(), two.most_j());
  ASSERT_TRUE(one.hand && two.hand);
  EXPECT_EQ(one.hand->scene, two.hand->scene);
  EXPECT_EQ(one.hand->taken_j, two.hand->taken_j);
  EXPECT_EQ(one.hand->typical_j, two.hand->typical_j);
  EXPECT_EQ(one.hand->least_j, two.hand->least_j);
  EXPECT_EQ(one.hand->last_second_w, two.hand->last_second_w);
}

TEST(WorstHand, AnotherSeedTriesOtherHands) {
  const Found first = found({tap_device("none", 0.5), 20, 1, Bounds::kWide});
  const Found second = found({tap_device("none", 0.5), 20, 2, Bounds::kWide});
  EXPECT_NE(first.most_j(), second.most_j());
}

TEST(WorstHand, ItsSceneTakesItsEnergyToTheLastDigit) {
  const Found result = found({tap_device("energy-bounding", 0.5), 1100, 1, Bounds::kNarrow});
  ASSERT_TRUE(result.hand);
  const FoundHand& hand = *result.hand;
  const Summary run = simulate(hand.scene).summary;
  EXPECT_EQ(-*run.passivity_margin_j, hand.taken_j);
  EXPECT_GT(hand.taken_j, kFoundJ);
  EXPECT_LE(hand.taken_j, result.most_j());
  EXPECT_LE(hand.least_j, hand.typical_j);
  EXPECT_EQ(hand.scene.x().hand->path.size(), 1U) << "it is let go";
}

TEST(WorstHand, ThePowerIsThatOfTheLastSecond) {
  const Found result = found({tap_device("none", 1.5), 20, 1, Bounds::kWide});
  ASSERT_TRUE(result.hand);
  std::vector<double> work_j;
  const SimulationResult run =
      simulate(result.hand->scene,
               {.on_sample = [&](const Sample& s) { work_j.push_back(s.truth.hand_work_j); },
                .should_stop = {},
                .changes = {}});
  EXPECT_EQ(result.hand->last_second_w, work_j.at(500) - *run.summary.true_hand_work_j);
  const Found brief = found({tap_device("none", 0.9), 20, 1, Bounds::kWide});
  ASSERT_TRUE(brief.hand);
  EXPECT_FALSE(brief.hand->last_second_w);
}

// N is the work of the hand on the handle. A ramp counts from the end of its path on, a hand that
// is let go from the start on.
TEST(WorstHand, ARampCountsTheEnergyAfterItsEnd) {
  Plan plan{tap_device("none", 2.0), 200, 1, Bounds::kWide};
  plan.motion = Motion::kRamp;
  const Found result = found(plan, 1);
  ASSERT_TRUE(result.hand);
  const FoundHand& hand = *result.hand;
  ASSERT_EQ(hand.scene.x().hand->path.size(), 2U);
  const double rest_s = hand.scene.x().hand->path.back().time_s;
  EXPECT_GT(rest_s, 0.0);
  double at_rest_j = 1.0;  // above 0: the path has not ended
  double least_j = 0.0;
  double least_at_rest_j = 0.0;
  const auto add = [&](double time_s, double net_work_j) {
    least_j = std::min(least_j, net_work_j);
    if (time_s < rest_s) return;
    if (at_rest_j > 0.0) at_rest_j = least_at_rest_j = std::min(net_work_j, 0.0);
    least_at_rest_j = std::min(least_at_rest_j, net_work_j);
  };
  const Summary run =
      simulate(hand.scene,
               {.on_sample = [&](const Sample& s) { add(s.time_s, s.truth.hand_work_j); },
                .should_stop = {},
                .changes = {}})
          .summary;
  add(run.duration_s, *run.true_hand_work_j);
  EXPECT_GT(hand.taken_at_rest_j, kFoundJ);
  EXPECT_EQ(hand.taken_at_rest_j, at_rest_j - least_at_rest_j);
  EXPECT_EQ(hand.taken_j, -*run.passivity_margin_j);
  EXPECT_NEAR(hand.taken_j, -least_j, 1e-12);
  EXPECT_NE(hand.taken_j, hand.taken_at_rest_j);
  EXPECT_EQ(found(plan, 2).hand->typical_j, hand.typical_j);

  plan.motion = Motion::kLetGo;
  const Found let_go = found(plan);
  ASSERT_TRUE(let_go.hand);
  EXPECT_EQ(let_go.hand->taken_j, let_go.hand->taken_at_rest_j);
  EXPECT_EQ(let_go.hand->scene.x().hand->path.size(), 1U);
}

TEST(WorstHand, NoRampTakesEnergyFromPassiveWalls) {
  Plan plan{tap_device("force-bounding", 1.0), 300, 1, Bounds::kWide};
  plan.motion = Motion::kRamp;
  EXPECT_FALSE(found(plan).first());
}

// The climb is worth its name: it finds more than as many hands of the sequence.
TEST(WorstHand, TheClimbFindsMoreThanTheFirstHands) {
  const Found first = found({tap_device("none", 0.3), 1024, 1, Bounds::kWide});
  const Found more = found({tap_device("none", 0.3), 2048, 1, Bounds::kWide});
  EXPECT_EQ(first.first(), more.first());
  EXPECT_GT(more.most_j(), 1.05 * first.most_j());
}

// Several hundred of these hands take energy, and kMaxRanked are ranked: those that took most, and
// not those that came first. Under `none` the hand with the largest typical energy is among them.
TEST(WorstHand, RanksTheHandsThatTookMost) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Found result = found({tap_device("none", 1.0), 1024, seed, Bounds::kWide});
    ASSERT_TRUE(result.hand);
    EXPECT_GT(result.hand->taken_j, 0.9 * result.most_j()) << seed;
  }
}

// Passive by theory, encoder and friction included.
TEST(WorstHand, FindsNoneUnderForceBoundingAndTheVirtualCoupling) {
  for (const char* algorithm : {"force-bounding", "virtual-coupling", "energy-bounding-2010"}) {
    const Found result = found({tap_device(algorithm, 1.0), 1500, 1, Bounds::kWide});
    EXPECT_EQ(result.hands, 1500U);
    EXPECT_FALSE(result.first()) << algorithm << ' ' << result.most_j();
    EXPECT_FALSE(result.hand);
  }
}

// K_c = 2b/T is the limit of the virtual coupling: 2000 N/m here.
TEST(WorstHand, FindsAVirtualCouplingThatIsTooStiff) {
  for (const double factor : {1.1, 1.5}) {
    Scene scene = ideal_device("virtual-coupling", 2.0);
    scene.x().walls.front().stiffness_n_per_m = 1e6;
    set_parameter(scene, "coupling_stiffness_n_per_m", factor * 2000.0);
    const Found result = found({scene, 1500, 1, Bounds::kWide});
    ASSERT_TRUE(result.first()) << factor;
    if (factor > 1.2) EXPECT_LE(*result.first(), 100U);
  }
  Scene right = ideal_device("virtual-coupling", 2.0);
  right.x().walls.front().stiffness_n_per_m = 1e6;
  set_parameter(right, "coupling_stiffness_n_per_m", 2000.0);
  EXPECT_FALSE(found({right, 1500, 1, Bounds::kWide}).first());
}

// With 1.44 b in the place of b the limit of the force is at least 1.2 times the right one.
TEST(WorstHand, FindsAForceBoundingWithALimitThatIsTooHigh) {
  Scene scene = ideal_device("force-bounding", 2.0);
  EXPECT_FALSE(found({scene, 500, 1, Bounds::kWide}).first());
  set_parameter(scene, "damping_n_s_per_m", 1.44);
  EXPECT_TRUE(found({scene, 500, 1, Bounds::kWide}).first());
}

TEST(WorstHand, EndsWithoutAResultOrWithTheHandsSoFar) {
  const Plan plan{tap_device("none", 0.3), 5000, 1, Bounds::kWide};
  EXPECT_FALSE(search(
      plan, {.threads = 0, .should_stop = [] { return true; }, .time_is_up = {}, .progress = {}}));
  std::vector<double> progress;
  const std::optional<Found> brief =
      search(plan, {.threads = 0,
                    .should_stop = {},
                    .time_is_up = [] { return true; },
                    .progress = [&](double fraction) { progress.push_back(fraction); }});
  ASSERT_TRUE(brief);
  EXPECT_EQ(brief->hands, 1024U);
  EXPECT_TRUE(std::ranges::is_sorted(progress));
  EXPECT_EQ(progress.back(), 1.0);
}

}  // namespace
}  // namespace hapticwall::worst_hand
