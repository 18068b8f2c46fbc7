// Blind trials: a balanced order from the seed, and exact statistics.
#include "app/compare/blind_trials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/compare/trial_results.h"

namespace hapticwall::compare {
namespace {

using ::testing::HasSubstr;

// Equal trials.
TrialPlan plan_of(std::size_t count, std::uint64_t seed = 1) {
  TrialPlan plan{seed, std::vector<file::TrialSpec>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    plan.trials[i].number = i + 1;
    plan.trials[i].slots = {"a", "b"};
  }
  return plan;
}

BlindTrials trials_of(const TrialPlan& plan) {
  auto trials = BlindTrials::create(plan);
  if (!trials) throw std::runtime_error(trials.error().message);
  return *trials;
}

// Feels both, and answers by `choice` of the slot that is first.
template <typename Choice>
std::vector<file::Answer> answers_of(const TrialPlan& plan, const Choice& choice) {
  BlindTrials trials = trials_of(plan);
  std::vector<file::Answer> answers;
  while (!trials.finished()) {
    trials.go_on();
    const Slot first = trials.present(Presentation::kFirst, 0.0);
    EXPECT_EQ(trials.present(Presentation::kSecond, 1.0), other(first));
    const Slot wanted = choice(first, trials.spec(), answers.size());
    answers.push_back(
        *trials.answer(first == wanted ? Presentation::kFirst : Presentation::kSecond, 2.0));
    EXPECT_EQ(answers.back().chosen, wanted);
    trials.take();
  }
  return answers;
}

// The slot of the first presentation of every trial.
std::string order_of(std::size_t count, std::uint64_t seed) {
  std::string order;
  const auto first_one = [](Slot first, const auto& /*spec*/, std::size_t /*i*/) { return first; };
  for (const file::Answer& answer : answers_of(plan_of(count, seed), first_one))
    order += slot_name(answer.first);
  return order;
}

TEST(BlindTrials, TheSeedDecidesTheOrderAlone) {
  EXPECT_EQ(order_of(20, 7), order_of(20, 7));
  EXPECT_NE(order_of(20, 7), order_of(20, 8));
  // The order is the same on every machine and in every version, because an experiment may be
  // continued.
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
  BlindTrials trials = trials_of(plan_of(2));
  EXPECT_THAT(trials.answer(Presentation::kFirst, 0.0).error().message, HasSubstr("feel both"));
  static_cast<void>(trials.present(Presentation::kFirst, 1.0));
  EXPECT_FALSE(trials.answer(Presentation::kFirst, 1.5));
  static_cast<void>(trials.present(Presentation::kSecond, 2.0));
  static_cast<void>(trials.present(Presentation::kFirst, 3.0));
  const auto answer = trials.answer(Presentation::kSecond, 4.5);
  ASSERT_TRUE(answer);
  EXPECT_EQ(trials.trial(), 0U) << "it does not count before it is stored";
  trials.take();
  EXPECT_EQ(trials.trial(), 1U);
  EXPECT_EQ(answer->looks, 3U);
  EXPECT_EQ(answer->seconds, 3.5);
  EXPECT_FALSE(trials.answer(Presentation::kFirst, 5.0)) << "the next trial's were not felt yet";
}

file::TrialSpec spec_of(std::uint64_t number, file::TrialKind kind, const std::string& b,
                        std::optional<Slot> correct = std::nullopt) {
  file::TrialSpec spec;
  spec.number = number;
  spec.kind = kind;
  spec.slots = {"k=1000", b};
  spec.correct = correct;
  return spec;
}

TEST(BlindTrials, ABreakWaitsAndIsNoTrial) {
  using file::TrialKind;
  const TrialPlan plan{1,
                       {spec_of(1, TrialKind::kBreak, ""), spec_of(2, TrialKind::kTest, "k=1100"),
                        spec_of(3, TrialKind::kBreak, ""), spec_of(4, TrialKind::kTest, "k=1100"),
                        spec_of(5, TrialKind::kBreak, "")}};
  BlindTrials trials = trials_of(plan);
  EXPECT_EQ(trials.planned(), 2U);
  EXPECT_TRUE(trials.at_break());
  trials.go_on();
  EXPECT_FALSE(trials.at_break());
  trials.go_on();
  EXPECT_EQ(trials.spec().number, 2U) << "a trial is not skipped";
  trials.take();
  EXPECT_TRUE(trials.at_break());
  trials.go_on();
  EXPECT_EQ(trials.spec().number, 4U);
  trials.take();
  EXPECT_TRUE(trials.finished());
  EXPECT_FALSE(trials.at_break());
  BlindTrials resumed = trials_of(plan);
  resumed.take();
  EXPECT_TRUE(resumed.at_break()) << "the break after the last answer comes again";
}

TEST(BlindTrials, EachPairIsBalancedByItself) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TrialPlan plan{seed, {}};
    for (std::uint64_t i = 0; i < 30; ++i)
      plan.trials.push_back(
          spec_of(i + 1, file::TrialKind::kTest, i % 3 == 0 ? "k=1100" : "k=900"));
    int a_first_of_1100 = 0;
    int a_first_of_900 = 0;
    const auto first_one = [](Slot first, const auto& /*spec*/, std::size_t /*i*/) {
      return first;
    };
    for (const file::Answer& answer : answers_of(plan, first_one))
      (answer.b == "k=1100" ? a_first_of_1100 : a_first_of_900) += answer.first == Slot::kA ? 1 : 0;
    EXPECT_EQ(a_first_of_1100, 5);
    EXPECT_EQ(a_first_of_900, 10);
  }
}

TEST(TrialResults, ChoicesAreCounted) {
  const auto answers =
      answers_of(plan_of(20, 3), [](Slot /*first*/, const auto& /*spec*/, std::size_t i) {
        return i < 15 ? Slot::kA : Slot::kB;
      });
  const TrialResults results = results_of(answers, 0.95);
  const TrialResult& result = results.tests;
  EXPECT_EQ(result.trials, 20U);
  EXPECT_EQ(result.chose_a, 15U);
  EXPECT_EQ(result.a.share, 0.75);
  EXPECT_NEAR(result.a.low, 0.5089541, 1e-7);
  EXPECT_NEAR(result.a.high, 0.9134285, 1e-7);
  ASSERT_EQ(results.pairs.size(), 1U);
  EXPECT_EQ(results.pairs.front().result.chose_a, 15U);
}

TEST(TrialResults, PracticeIsNotCountedAndCatchTrialsStandApart) {
  using file::TrialKind;
  const TrialPlan plan{
      1,
      {spec_of(1, TrialKind::kPractice, "k=2000", Slot::kB),
       spec_of(2, TrialKind::kTest, "k=1100", Slot::kB),
       spec_of(3, TrialKind::kTest, "k=1100", Slot::kB),
       spec_of(4, TrialKind::kTest, "k=900", Slot::kA),
       spec_of(5, TrialKind::kCatch, "k=3000", Slot::kB), spec_of(6, TrialKind::kCatch, "k=1000")}};
  const auto answers =
      answers_of(plan, [](Slot /*first*/, const file::TrialSpec& spec, std::size_t) {
        return spec.number == 3 ? Slot::kA : Slot::kB;
      });
  EXPECT_EQ(answers.front().correct, true);
  EXPECT_EQ(answers.back().correct, std::nullopt);
  const TrialResults results = results_of(answers, 0.95);
  EXPECT_EQ(results.practice, 1U);
  EXPECT_EQ(results.tests.judged, 3U);
  EXPECT_EQ(results.tests.correct, 1U);
  EXPECT_EQ(results.catches.trials, 2U);
  EXPECT_EQ(results.catches.judged, 1U);
  EXPECT_EQ(results.catches.correct, 1U);
  ASSERT_EQ(results.pairs.size(), 4U);
  EXPECT_EQ(results.pairs[0].b, "k=1100");
  EXPECT_EQ(results.pairs[0].result.trials, 2U);
  EXPECT_EQ(results.pairs[0].result.chose_a, 1U);
}

TEST(BlindTrials, PlansOutOfRangeAreRefused) {
  TrialPlan plan = plan_of(2);
  EXPECT_FALSE(BlindTrials::create(plan_of(0)));
  EXPECT_FALSE(BlindTrials::create(plan_of(kMaxTrials + 1)));
  EXPECT_TRUE(BlindTrials::create(plan));
  plan.confidence = 1.0;
  EXPECT_FALSE(BlindTrials::create(plan));
  plan.confidence = std::nan("");
  EXPECT_FALSE(BlindTrials::create(plan));
}

TEST(ClopperPearson, KnownIntervals) {
  struct Known {
    std::uint32_t k, n;
    double confidence, low, high;
  };
  // The values are those of tables and of R's binom.test().
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
      // The interval of n - k mirrors that of k.
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
  EXPECT_NEAR(binomial_at_least(3, 5, 0.25), (10.0 * 9.0 + 5.0 * 3.0 + 1.0) / 1024.0, 1e-15);
  EXPECT_EQ(binomial_at_least(1, 5, 0.0), 0.0);
  EXPECT_EQ(binomial_at_least(5, 5, 1.0), 1.0);
  EXPECT_EQ(binomial_at_least(6, 5, 0.5), 0.0);
}

}  // namespace
}  // namespace hapticwall::compare
