// Blind trials: a balanced order from the seed, and exact statistics.
#include "app/compare/blind_trials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hapticwall::compare {
namespace {

using ::testing::HasSubstr;

BlindTrials trials_of(std::size_t count, std::uint64_t seed = 1) {
  auto trials = BlindTrials::create({.seed = seed, .trials = count});
  if (!trials) throw std::runtime_error(trials.error().message);
  return *trials;
}

// The slot of the first presentation of every trial.
std::string order_of(std::size_t count, std::uint64_t seed) {
  BlindTrials trials = trials_of(count, seed);
  std::string order;
  while (!trials.finished()) {
    const Slot first = trials.present(Presentation::kFirst, 0.0);
    EXPECT_EQ(trials.present(Presentation::kSecond, 0.0), other(first));
    order += slot_name(first);
    EXPECT_FALSE(trials.choose(Presentation::kFirst, 1.0));
  }
  return order;
}

TEST(BlindTrials, TheSeedDecidesTheOrderAlone) {
  EXPECT_EQ(order_of(20, 7), order_of(20, 7));
  EXPECT_NE(order_of(20, 7), order_of(20, 8));
  // The same on every machine and in every version, because an experiment may be continued.
  EXPECT_EQ(order_of(10, 1), "AAABBBAABB");
}

TEST(BlindTrials, TheOrderIsBalanced) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const std::string even = order_of(20, seed);
    EXPECT_EQ(std::count(even.begin(), even.end(), 'A'), 10);
    const std::string odd = order_of(21, seed);
    EXPECT_NEAR(static_cast<double>(std::count(odd.begin(), odd.end(), 'A')), 10.5, 0.5);
  }
}

// Both slots are about equally frequent at every position.
TEST(BlindTrials, NoPlaceInTheOrderKnowsMoreThanAnother) {
  std::vector<int> a_first(10, 0);
  constexpr int kSeeds = 2000;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const std::string order = order_of(10, static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < order.size(); ++i) a_first[i] += order[i] == 'A' ? 1 : 0;
  }
  for (const int count : a_first)
    EXPECT_NEAR(count, 0.5 * kSeeds, 110);  // five standard deviations
}

TEST(BlindTrials, BothAreFeltBeforeOneIsChosen) {
  BlindTrials trials = trials_of(2);
  EXPECT_THAT(trials.choose(Presentation::kFirst, 0.0)->message, HasSubstr("feel both"));
  static_cast<void>(trials.present(Presentation::kFirst, 1.0));
  EXPECT_TRUE(trials.choose(Presentation::kFirst, 1.5));
  static_cast<void>(trials.present(Presentation::kSecond, 2.0));
  static_cast<void>(trials.present(Presentation::kFirst, 3.0));
  EXPECT_FALSE(trials.choose(Presentation::kSecond, 4.5));
  EXPECT_EQ(trials.trial(), 1U);
  EXPECT_EQ(trials.trials().front().looks, 3U);
  EXPECT_EQ(trials.trials().front().seconds, 3.5);
  EXPECT_TRUE(trials.choose(Presentation::kFirst, 5.0));  // the next trial's were not felt yet
}

TEST(BlindTrials, ChoicesAreCounted) {
  BlindTrials trials = trials_of(20, 3);
  for (int i = 0; i < 20; ++i) {
    const Slot first = trials.present(Presentation::kFirst, 0.0);
    static_cast<void>(trials.present(Presentation::kSecond, 1.0));
    const bool want_a = i < 15;
    const bool take_first = (first == Slot::kA) == want_a;
    EXPECT_FALSE(trials.choose(take_first ? Presentation::kFirst : Presentation::kSecond, 2.0));
  }
  EXPECT_TRUE(trials.finished());
  EXPECT_TRUE(trials.choose(Presentation::kFirst, 3.0));
  const TrialResult& result = trials.result();
  EXPECT_EQ(result.trials, 20U);
  EXPECT_EQ(result.chose_a, 15U);
  EXPECT_EQ(result.a.share, 0.75);
  EXPECT_NEAR(result.a.low, 0.5089541, 1e-7);
  EXPECT_NEAR(result.a.high, 0.9134285, 1e-7);
  EXPECT_NEAR(result.p_value, 0.04138947, 1e-8);
}

TEST(BlindTrials, EverythingIsInTheTables) {
  auto trials = BlindTrials::create(
      {.seed = 1, .trials = 2, .question = "Which is stiffer, \"harder\"?", .confidence = 0.9});
  ASSERT_TRUE(trials);
  const Slot first = trials->present(Presentation::kFirst, 10.0);
  EXPECT_EQ(first, Slot::kA);
  static_cast<void>(trials->present(Presentation::kSecond, 11.0));
  EXPECT_FALSE(trials->choose(Presentation::kSecond, 12.25));
  EXPECT_EQ(trials->trials_csv("none", "x (k = 1, l = 2)"),
            "trial,question,seed,a,b,first,second,chosen,chosen_presentation,looks,seconds\n"
            "1,\"Which is stiffer, \"\"harder\"\"?\",1,none,\"x (k = 1, l = 2)\",A,B,B,2,2,2.25\n");
  EXPECT_THAT(trials->result_csv("none", "b"),
              HasSubstr("p_value\n\"Which is stiffer, \"\"harder\"\"?\",1,none,b,2,1,0,0,0,0.9,0,"
                        "0.95"));
}

TEST(BlindTrials, PlansOutOfRangeAreRefused) {
  EXPECT_FALSE(BlindTrials::create({.trials = 0}));
  EXPECT_FALSE(BlindTrials::create({.trials = kMaxTrials + 1}));
  EXPECT_FALSE(BlindTrials::create({.confidence = 1.0}));
  EXPECT_FALSE(BlindTrials::create({.confidence = std::nan("")}));
}

TEST(ClopperPearson, KnownIntervals) {
  struct Known {
    std::uint32_t k, n;
    double confidence, low, high;
  };
  // As tables and R's binom.test() give them.
  for (const Known& known : {Known{0, 10, 0.95, 0.0, 0.3084971},
                             {10, 10, 0.95, 0.6915029, 1.0},
                             {5, 10, 0.95, 0.1870860, 0.8129140},
                             {8, 10, 0.95, 0.4439045, 0.9747893},
                             {15, 20, 0.95, 0.5089541, 0.9134285},
                             {60, 100, 0.95, 0.4972092, 0.6967052},
                             {1, 1, 0.95, 0.025, 1.0}}) {
    SCOPED_TRACE(std::to_string(known.k) + " of " + std::to_string(known.n));
    const Proportion found = clopper_pearson(known.k, known.n, known.confidence);
    EXPECT_NEAR(found.low, known.low, 6e-8);
    EXPECT_NEAR(found.high, known.high, 6e-8);
  }
}

TEST(ClopperPearson, ClosedFormsAtTheEdges) {
  for (const std::uint32_t n : {1U, 3U, 20U, 1000U}) {
    for (const double confidence : {0.5, 0.95, 0.999}) {
      const double edge = std::pow(0.5 * (1.0 - confidence), 1.0 / n);
      EXPECT_NEAR(clopper_pearson(0, n, confidence).high, 1.0 - edge, 1e-12);
      EXPECT_NEAR(clopper_pearson(n, n, confidence).low, edge, 1e-12);
      EXPECT_EQ(clopper_pearson(0, n, confidence).low, 0.0);
      EXPECT_EQ(clopper_pearson(n, n, confidence).high, 1.0);
    }
  }
}

TEST(ClopperPearson, IsWhatItsDefinitionSays) {
  for (const std::uint32_t n : {7U, 40U, 1000U}) {
    for (std::uint32_t k = 1; k < n; k += n / 7 + 1) {
      const Proportion found = clopper_pearson(k, n, 0.95);
      EXPECT_NEAR(binomial_at_least(k, n, found.low), 0.025, 1e-10);
      EXPECT_NEAR(1.0 - binomial_at_least(k + 1, n, found.high), 0.025, 1e-10);
      // Both sides are treated alike.
      const Proportion mirrored = clopper_pearson(n - k, n, 0.95);
      EXPECT_NEAR(mirrored.low, 1.0 - found.high, 1e-14);
      EXPECT_LT(found.low, found.share);
      EXPECT_GT(found.high, found.share);
    }
  }
  const Proportion nothing = clopper_pearson(0, 0, 0.95);
  EXPECT_EQ(nothing.low, 0.0);
  EXPECT_EQ(nothing.high, 1.0);
}

TEST(BinomialTest, KnownValues) {
  EXPECT_NEAR(binomial_two_sided(8, 10), 112.0 / 1024.0, 1e-15);
  EXPECT_NEAR(binomial_two_sided(2, 10), 112.0 / 1024.0, 1e-15);
  EXPECT_NEAR(binomial_two_sided(10, 10), 2.0 / 1024.0, 1e-17);
  EXPECT_NEAR(binomial_two_sided(60, 100), 0.05688793, 1e-8);
  EXPECT_EQ(binomial_two_sided(5, 10), 1.0);
  EXPECT_EQ(binomial_two_sided(0, 0), 1.0);
  EXPECT_NEAR(binomial_at_least(3, 5, 0.25), (10.0 * 9.0 + 5.0 * 3.0 + 1.0) / 1024.0, 1e-15);
  EXPECT_EQ(binomial_at_least(1, 5, 0.0), 0.0);
  EXPECT_EQ(binomial_at_least(5, 5, 1.0), 1.0);
  EXPECT_EQ(binomial_at_least(6, 5, 0.5), 0.0);
}

}  // namespace
}  // namespace hapticwall::compare
