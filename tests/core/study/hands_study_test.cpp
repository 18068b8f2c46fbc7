// Several hands on one scene: against single runs, against theory, and the worst and the median.
#include "core/study/hands_study.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/core/study/study_scenes.h"

namespace hapticwall {
namespace {

std::optional<double> chatter_of(const Summary& run) { return run.chatter_n; }

StudiedHand damped_hand(const std::string& name, double damping_n_s_per_m) {
  HandSettings numbers;
  numbers.stiffness_n_per_m = 5.0;
  numbers.damping_n_s_per_m = damping_n_s_per_m;
  return {name, numbers};
}

// A bare wall on 0.05 kg and 1 N·s/m is stable below 2006.69 N/m at 1 kHz (eigenvalues of the
// sampled loop, tests/golden/analytic_limits_test.cpp), and below about 2b/T with a hand's damping
// added to b: the same wall of 2400 N/m fails with one hand and holds with the others.
HandsPlan plan_of_damped_hands() {
  HandsPlan plan;
  plan.scene = testing::pressed_wall(2400.0);
  plan.scene.duration_s = 8.0;
  plan.hands = {damped_hand("damped", 5.0), damped_hand("bare", 0.0), damped_hand("more", 8.0)};
  plan.algorithms = {*find_algorithm("none")};
  return plan;
}

TEST(HandsStudy, TellsTheHandThatTheoryTells) {
  const std::vector<HandsRow> rows = study_hands(plan_of_damped_hands());
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].algorithm, "none");
  EXPECT_FALSE(is_good(rows[0].own.verdict)) << "the own hand is the bare one";
  EXPECT_EQ(rows[0].good(), 2U);
  EXPECT_EQ(rows[0].worst(), 1U);
  EXPECT_EQ(rows[0].median_verdict(), Verdict::kSettled);
  EXPECT_GT(*max_of(rows[0].runs, chatter_of), *median_of(rows[0].runs, chatter_of));
}

TEST(HandsStudy, EqualsSingleRuns) {
  HandsPlan plan = plan_of_damped_hands();
  plan.scene.duration_s = 1.5;
  plan.algorithms = {*find_algorithm("passivity-control"), *find_algorithm("energy-bounding")};
  for (const int threads : {1, 3}) {
    const std::vector<HandsRow> rows =
        study_hands(plan, {.threads = threads, .should_stop = {}, .progress = {}});
    const auto compared = compared_algorithms(plan.scene.algorithm, plan.algorithms);
    ASSERT_EQ(rows.size(), compared.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Scene scene = plan.scene;
      scene.algorithm = compared[i].settings;
      EXPECT_EQ(rows[i].algorithm, compared[i].label);
      EXPECT_EQ(rows[i].own.energy_scv_j, simulate(scene).summary.energy_scv_j);
      for (std::size_t hand = 0; hand < plan.hands.size(); ++hand) {
        scene.x().hand->damping_n_s_per_m = plan.hands[hand].numbers.damping_n_s_per_m;
        const Summary single = simulate(scene).summary;
        EXPECT_EQ(rows[i].runs[hand].verdict, single.verdict);
        EXPECT_EQ(rows[i].runs[hand].energy_scv_j, single.energy_scv_j);
        EXPECT_EQ(rows[i].runs[hand].tail_peak_to_peak_m, single.tail_peak_to_peak_m);
      }
    }
  }
}

Summary made_up_run(Verdict verdict, std::optional<double> chatter_n, double given_j = 0.0) {
  Summary run;
  run.verdict = verdict;
  run.chatter_n = chatter_n;
  run.given_j = given_j;
  return run;
}

TEST(HandsStudy, WorstAndMedianBelongToARun) {
  HandsRow row;
  row.runs = {made_up_run(Verdict::kSettled, 0.2), made_up_run(Verdict::kBuzzing, 0.4, 1.0),
              made_up_run(Verdict::kMoving, std::nullopt),
              made_up_run(Verdict::kBuzzing, 0.4, 2.0)};
  EXPECT_EQ(row.good(), 2U);
  EXPECT_EQ(row.worst(), 3U) << "equal in verdict and chatter, and it gave more";
  EXPECT_EQ(row.median_verdict(), Verdict::kBuzzing) << "the worse one of the two in the middle";
  EXPECT_EQ(median_of(row.runs, chatter_of), 0.4);
  EXPECT_EQ(min_of(row.runs, chatter_of), 0.2);
  EXPECT_EQ(max_of(row.runs, chatter_of), 0.4);
  row.runs = {made_up_run(Verdict::kNoContact, std::nullopt)};
  EXPECT_EQ(row.good(), 0U);
  EXPECT_EQ(median_of(row.runs, chatter_of), std::nullopt);
}

TEST(HandsStudy, AWrongPlanIsRefused) {
  HandsPlan plan = plan_of_damped_hands();
  EXPECT_FALSE(validate(plan));
  plan.hands[1].numbers.stiffness_n_per_m = -1.0;
  ASSERT_TRUE(validate(plan));
  EXPECT_EQ(validate(plan)->key, "hand.stiffness_n_per_m");
  EXPECT_EQ(validate(plan)->message.rfind("bare: ", 0), 0U);
  plan.hands.clear();
  EXPECT_TRUE(validate(plan));
  plan = plan_of_damped_hands();
  plan.scene.x().hand.reset();
  EXPECT_TRUE(validate(plan));
}

TEST(HandsStudy, CanBeEnded) {
  std::atomic<int> questions = 0;
  const auto stop = [&] { return ++questions > 2; };
  EXPECT_TRUE(
      study_hands(plan_of_damped_hands(), {.threads = 1, .should_stop = stop, .progress = {}})
          .empty());
}

}  // namespace
}  // namespace hapticwall
