// A study as a table, as JSON and as CSV.
#include "app/study/ranking/ranking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapticwall::study::ranking {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

ContactStudyPlan made_up_plan() {
  ContactStudyPlan plan;
  plan.scene.name = "a, \"b\"\xff";
  plan.scene.x().walls = {{0.05, 35000.0, 0.0}};
  plan.algorithms = {0};
  return plan;
}

ContactMetrics made_up_row() {
  ContactMetrics row;
  row.summary.algorithm = "none";
  row.summary.verdict = Verdict::kOscillating;
  return row;
}

TEST(RankingOutcome, AFigureThatDoesNotApplyIsADashAndNull) {
  const std::vector<ContactMetrics> rows{made_up_row()};
  const std::string table = table::sheet_text(outcome_of(made_up_plan(), rows).sheet);
  EXPECT_THAT(table, HasSubstr("met at - m/s"));
  EXPECT_THAT(table, AllOf(Not(HasSubstr("!")), Not(HasSubstr("*"))));
  const auto json = nlohmann::json::parse(outcome_of(made_up_plan(), rows).json);
  for (const char* key : {"stiffest_n_per_m", "stiffest_tail_force_std_n", "first_failure",
                          "last_settled", "rate_hardness_n_per_m", "rise_time_s",
                          "peak_penetration_m", "tail_peak_to_peak_m", "stable_below_n_per_m"}) {
    EXPECT_TRUE(json.at("rows")[0].at(key).is_null()) << key;
  }
  EXPECT_EQ(json.at("rows")[0].at("energy_to_hand_j"), 0.0);
  EXPECT_THAT(outcome_of(made_up_plan(), rows).csv,
              HasSubstr("\n\"a, \"\"b\"\"\xff\",6,1000,35000,"));
}

TEST(RankingOutcome, SaysWhatChai3dAllowsOnTheDevice) {
  ContactStudyPlan plan = made_up_plan();
  const std::vector<ContactMetrics> rows{made_up_row()};
  plan.scene.x().device.chai3d_stiffness_n_per_m = 800.0;
  EXPECT_THAT(table::sheet_text(outcome_of(plan, rows).sheet), Not(HasSubstr("CHAI3D")));
  plan.scene.x().device.chai3d_damping_n_s_per_m = 5.0;
  EXPECT_THAT(table::sheet_text(outcome_of(plan, rows).sheet),
              HasSubstr("\nCHAI3D allows on this device: a wall of at most 0.80 kN/m, 5 N s/m\n"));
}

TEST(RankingOutcome, MarksAreExplainedWhereTheyOccur) {
  ContactMetrics row = made_up_row();
  row.limits = {0, {}, {100.0, 142'000.0}, {7279.0, 1e6}, 3, Summary{}, {}};
  row.limits.at_settled->displayed_stiffness_n_per_m = 7277.0;
  row.limits.at_settled->tail_force_std_n = 0.27;
  row.approach_speed_m_per_s = 0.03;
  row.rate_hardness_n_per_m = 44'350.0;
  row.rise_kind = RiseKind::kOneTick;
  const std::string table = table::sheet_text(outcome_of(made_up_plan(), {row}).sheet);
  EXPECT_THAT(table, AllOf(HasSubstr("met at 0.030 m/s"), HasSubstr("7.28   0.27"),
                           HasSubstr(" 7.28        142.00        3 ! "), HasSubstr(" 44.35 * "),
                           HasSubstr("\n! the verdict changes more than once"),
                           HasSubstr("\n* one jump in one tick")));
  const auto json = nlohmann::json::parse(outcome_of(made_up_plan(), {row}).json);
  EXPECT_EQ(json.at("rows")[0].at("rate_hardness_of"), "one-tick");
  row.rise_kind = RiseKind::kToTheLimit;
  EXPECT_THAT(table::sheet_text(outcome_of(made_up_plan(), {row}).sheet),
              AllOf(HasSubstr(" 44.35 + "), HasSubstr("\n+ limited by the force limit\n"),
                    Not(HasSubstr("*"))));
  row.limits.changes = 1;
  row.limits.stable_below_n_per_m = 2006.7;
  EXPECT_THAT(outcome_of(made_up_plan(), {row}).json,
              HasSubstr("\"stable_below_n_per_m\": 2006.7"));
  EXPECT_THAT(table::sheet_text(outcome_of(made_up_plan(), {row}).sheet), Not(HasSubstr("!")));
}

}  // namespace
}  // namespace hapticwall::study::ranking
