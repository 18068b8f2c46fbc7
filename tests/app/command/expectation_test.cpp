// --expect, and the summary as JSON and CSV.
#include "app/command/report/expectation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "app/command/report/summary_fields.h"
#include "app/command/report/summary_table.h"

namespace hapticwall::command {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Summary example() {
  Summary summary;
  summary.scene = "press";
  summary.algorithm = "none";
  summary.verdict = Verdict::kOscillating;
  summary.duration_s = 6.0;
  summary.ticks = 6000;
  summary.tail_peak_to_peak_m = 0.0028;
  return summary;
}

bool holds(const std::string& text) {
  const Result<Expectation> expectation = parse_expectation(text);
  EXPECT_TRUE(expectation) << expectation.error().message;
  return expectation && !unmet(*expectation, {example()});
}

TEST(Expectation, EveryOperator) {
  for (const char* text : {"=6000", "<6001", "<=6000", ">5999", ">=6000"}) {
    EXPECT_TRUE(holds(std::string("ticks") + text)) << text;
  }
  for (const char* text : {"=5999", "<6000", "<=5999", ">6000", ">=6001"}) {
    EXPECT_FALSE(holds(std::string("ticks") + text)) << text;
  }
}

TEST(Expectation, NumbersAndWords) {
  EXPECT_TRUE(holds("tail_peak_to_peak_m > 1e-4"));
  EXPECT_FALSE(holds("tail_peak_to_peak_m<1e-4"));
  EXPECT_TRUE(holds("verdict=oscillating"));
  EXPECT_FALSE(holds("verdict = settled"));
  EXPECT_TRUE(holds("algorithm=none"));
}

TEST(Expectation, AnOldNameOfAnAlgorithmMeansThePresentOne) {
  Summary summary = example();
  summary.algorithm = "energy-limited-spring";
  for (const char* text : {"algorithm=energy-bookkeeping", "algorithm=energy-limited-spring"}) {
    EXPECT_FALSE(unmet(*parse_expectation(text), {summary})) << text;
  }
  EXPECT_TRUE(unmet(*parse_expectation("algorithm=energy-bookkeeping"), {example()}));
}

TEST(Expectation, NullFailsEveryComparison) {
  for (const std::string sign : {"<", "<=", "=", ">=", ">"}) {
    EXPECT_FALSE(holds("displayed_stiffness_n_per_m" + sign + "0"));
  }
  const Result<Expectation> expectation = parse_expectation("displayed_stiffness_n_per_m>0");
  EXPECT_THAT(unmet(*expectation, {example()}).value(), HasSubstr("= null"));
}

TEST(Expectation, SaysWhatWasFound) {
  EXPECT_EQ(
      unmet(*parse_expectation("tail_peak_to_peak_m<1e-4"), {example()}),
      "expected tail_peak_to_peak_m<1e-4, found tail_peak_to_peak_m = 0.0028 (press under none)");
}

TEST(SummaryFields, KeysAndOrderAreThePromisedOnes) {
  std::string keys;
  for (const SummaryField& field : summary_fields(RunSummary(1)))
    keys += std::string(field.key) + " ";
  EXPECT_EQ(keys,
            "scene algorithm verdict duration_s ticks simulated_seconds_per_second ns_per_tick "
            "tail_peak_to_peak_m tail_force_mean_n tail_force_std_n displayed_stiffness_n_per_m "
            "chatter_n swing_m shake_m_per_s2 given_j given_w "
            "max_penetration_m peak_force_n saturated_ticks contacts energy_cv_j energy_hold_j "
            "energy_scv_j energy_budget_j min_energy_cv_j min_energy_scv_j true_actuator_work_j "
            "true_dissipation_j true_hand_work_j kinetic_j energy_balance_error_j "
            "energy_balance_relative passivity_margin_j diverged_at_tick verdict_note ");
}

TEST(SummaryFields, JsonHasNullWhereNothingApplies) {
  Summary summary = example();
  summary.energy_cv_j = std::numeric_limits<double>::quiet_NaN();
  summary.peak_force_n = std::numeric_limits<double>::infinity();
  summary.kinetic_j = 0.1 + 0.2;
  summary.scene = "bad \xff name";
  const auto json = nlohmann::ordered_json::parse(summary_json({summary}));
  EXPECT_TRUE(json.at("energy_cv_j").is_null());
  EXPECT_TRUE(json.at("peak_force_n").is_null());
  EXPECT_TRUE(json.at("displayed_stiffness_n_per_m").is_null());
  EXPECT_TRUE(json.at("diverged_at_tick").is_null());
  EXPECT_EQ(json.at("kinetic_j").get<double>(), 0.1 + 0.2);
  EXPECT_TRUE(json.at("ticks").is_number_integer());
  EXPECT_EQ(json.begin().key(), "scene");
  for (const SummaryField& field : summary_fields({summary})) {
    EXPECT_NE(value_text(field.value), "nan") << field.key;
  }
  EXPECT_EQ(nlohmann::json::parse(summaries_json({{summary}, {summary}})).size(), 2U);
}

TEST(SummaryFields, CsvQuotesAndLeavesNullEmpty) {
  Summary summary = example();
  summary.scene = "a, \"b\"";
  const std::string text = summaries_csv({RunSummary{summary}});
  EXPECT_THAT(text, HasSubstr("\n\"a, \"\"b\"\"\",none,oscillating,6,6000,,,0.0028,"));
}

TEST(SummaryTable, AlignsItsColumns) {
  Summary first = example();
  Summary second = example();
  second.algorithm = "a-long-name-for-an-algorithm";
  second.energy_cv_j = -1e-9;
  const std::string table = comparison_table({{first}, {second}});
  EXPECT_THAT(table, HasSubstr("\nnone                          oscillating     2.800"));
  EXPECT_THAT(table, HasSubstr("\na-long-name-for-an-algorithm  oscillating     2.800"));
  EXPECT_EQ(table.find("-0.00"), std::string::npos) << table;
}

TEST(SummaryTable, TheVerdictComesFirst) {
  Summary summary = example();
  summary.verdict = Verdict::kDiverged;
  summary.diverged_at_tick = 12;
  EXPECT_THAT(summary_lines({summary}, {}), StartsWith("press under none: diverged at tick 12\n"));
}

TEST(SummaryTable, TellsHowLongATailIs) {
  Summary summary = example();
  EXPECT_THAT(summary_lines({summary}, {}), HasSubstr("  last second  "));
  summary.verdict_note = "the run is shorter";
  EXPECT_THAT(summary_lines({summary}, {}), HasSubstr("  whole run  "));
  summary.verdict_note.reset();
  summary.tail_peak_to_peak_m.reset();  // diverged before it
  EXPECT_THAT(summary_lines({summary}, {}), HasSubstr("  last second           not reached"));
}

TEST(SummaryTable, TellsOfAHandOnItsWay) {
  EXPECT_THAT(summary_lines({example()}, {}), Not(HasSubstr("note")));
  EXPECT_THAT(summary_lines({example()}, {"", true}),
              HasSubstr("\n  note                  the hand's script still moves"));
}

TEST(SummaryTable, AHandIsOnItsWayWhereItsScriptMovesInTheTail) {
  Scene scene;
  scene.x().hand.emplace();
  scene.x().hand->path = {{0.0, 0.0}, {2.0, 0.1}, {4.0, 0.1}};
  Summary simulated;
  simulated.true_hand_work_j = 0.0;
  EXPECT_TRUE(hand_moves_in_tail(scene, {simulated}, 0.5));
  EXPECT_TRUE(hand_moves_in_tail(scene, {simulated}, 2.9));
  EXPECT_FALSE(hand_moves_in_tail(scene, {simulated}, 3.1));
  EXPECT_FALSE(hand_moves_in_tail(scene, {simulated}, 9.0));
  EXPECT_FALSE(hand_moves_in_tail(scene, {Summary{}}, 2.0)) << "a person holds a device";
  Summary diverged = simulated;
  diverged.verdict = Verdict::kDiverged;
  EXPECT_FALSE(hand_moves_in_tail(scene, {diverged}, 2.0));
  scene.axes.resize(2);
  scene.axes[1].hand.emplace();
  scene.axes[1].hand->path = {{0.0, 0.0}, {3.5, 0.1}};
  EXPECT_TRUE(hand_moves_in_tail(scene, {simulated}, 4.4));
  EXPECT_FALSE(hand_moves_in_tail(scene, {simulated}, 4.6));
}

}  // namespace
}  // namespace hapticwall::command
