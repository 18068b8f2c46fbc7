// A study as a table, as JSON and as CSV.
#include "app/study/accuracy/accuracy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace hapticwall::study::accuracy {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

AccuracyStudy made_up() {
  AccuracyStudy study;
  study.reference.scene = "a, \"b\"\xff";
  study.reference.algorithm = "none";
  study.reference.verdict = Verdict::kOscillating;
  study.reference.duration_s = 5.0;
  study.reference.ticks = 5000;
  study.reference.tail_peak_to_peak_m = 0.5e-3;
  AccuracyRow exact;
  exact.ns_per_tick = 7.0;
  exact.ratio_to_exact = 1.0;
  exact.set_up_ns = 29'000.0;
  exact.max_position_error_m = 4e-16;
  exact.energy_balance_error_j = -1e-15;
  exact.energy_balance_relative = 3e-15;
  exact.tail_peak_to_peak_m = 0.5e-3;
  exact.tail_peak_to_peak_relative_error = -1e-12;
  exact.verdict = Verdict::kOscillating;
  exact.verdict_agrees = true;
  AccuracyRow quiet = exact;
  quiet.integrator = Integrator::kSemiImplicitEuler;
  quiet.substeps = 1;
  quiet.ns_per_tick = 14.0;
  quiet.ratio_to_exact = 2.0;
  quiet.tail_peak_to_peak_m = 0.0;
  quiet.tail_peak_to_peak_relative_error = -1.0;
  quiet.verdict = Verdict::kSettled;
  quiet.verdict_agrees = false;
  AccuracyRow diverged;
  diverged.integrator = Integrator::kRungeKutta4;
  diverged.substeps = 1000;
  diverged.ns_per_tick = std::numeric_limits<double>::infinity();
  diverged.verdict = Verdict::kDiverged;
  diverged.diverged_at_tick = 12;
  study.rows = {exact, quiet, diverged};
  return study;
}

TEST(AccuracyOutcome, TheTableSaysWhoIsWrong) {
  const std::string table = table::sheet_text(outcome_of(made_up()).sheet);
  EXPECT_THAT(table, HasSubstr("reference: oscillating, 0.5000 mm peak to peak"));
  EXPECT_THAT(table, HasSubstr("  0.5000       0.00  oscillating\n"));
  EXPECT_THAT(table, HasSubstr("  -1.0e-15      3.0e-15  "));
  EXPECT_THAT(table, HasSubstr("    -100.00  settled !\n"));
  EXPECT_THAT(table, HasSubstr("  diverged at tick 12 !\n"));
  EXPECT_THAT(table, HasSubstr("\n! the verdict differs from the reference's\n"));
  EXPECT_THAT(table, Not(HasSubstr("inf")));
  AccuracyStudy agreeing = made_up();
  agreeing.rows.resize(1);
  EXPECT_THAT(table::sheet_text(outcome_of(agreeing).sheet), Not(HasSubstr("!")));
}

// The row `exact` does not test the equations that it shares with the reference.
TEST(AccuracyOutcome, TheTableAndTheJsonSayThatTheReferenceSharesTheCode) {
  EXPECT_THAT(table::sheet_text(outcome_of(made_up()).sheet),
              HasSubstr("an error of the common equations does not show"));
  EXPECT_EQ(nlohmann::json::parse(outcome_of(made_up()).json).at("reference"),
            "exact integrator in extended precision");
}

TEST(AccuracyOutcome, TheTableOfADivergedReferenceSaysSo) {
  AccuracyStudy study = made_up();
  study.reference.verdict = Verdict::kDiverged;
  study.reference.diverged_at_tick = 7;
  EXPECT_THAT(table::sheet_text(outcome_of(study).sheet),
              HasSubstr("reference: diverged at tick 7; errors"));
}

TEST(AccuracyOutcome, JsonHasEveryKeyAndNullForWhatDoesNotApply) {
  const auto json = nlohmann::json::parse(outcome_of(made_up()).json);
  EXPECT_EQ(json.at("algorithm"), "none");
  EXPECT_EQ(json.at("ticks"), 5000);
  EXPECT_EQ(json.at("reference_verdict"), "oscillating");
  EXPECT_EQ(json.at("reference_tail_peak_to_peak_m"), 0.5e-3);
  EXPECT_TRUE(json.at("reference_diverged_at_tick").is_null());
  const auto& rows = json.at("rows");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("integrator"), "exact");
  EXPECT_TRUE(rows[0].at("substeps").is_null());
  EXPECT_EQ(rows[0].at("max_position_error_m"), 4e-16);
  EXPECT_EQ(rows[0].at("verdict_agrees"), true);
  EXPECT_EQ(rows[1].at("substeps"), 1);
  EXPECT_EQ(rows[1].at("ratio_to_exact"), 2.0);
  EXPECT_EQ(rows[1].at("tail_peak_to_peak_relative_error"), -1.0);
  EXPECT_EQ(rows[1].at("verdict"), "settled");
  EXPECT_EQ(rows[1].at("verdict_agrees"), false);
  EXPECT_EQ(rows[2].at("diverged_at_tick"), 12);
  for (const char* key :
       {"ns_per_tick", "set_up_ns", "max_position_error_m", "energy_balance_error_j",
        "energy_balance_relative", "tail_peak_to_peak_m", "tail_peak_to_peak_relative_error",
        "ratio_to_exact"}) {
    EXPECT_TRUE(rows[2].at(key).is_null()) << key;
  }
}

TEST(AccuracyOutcome, CsvIsTheSameFlat) {
  const std::string csv = outcome_of(made_up()).csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_THAT(
      csv,
      AllOf(StartsWith("scene,algorithm,duration_s,ticks,reference_verdict,"
                       "reference_tail_peak_to_peak_m,reference_diverged_at_tick,integrator,"
                       "substeps,ns_per_tick,ratio_to_exact,set_up_ns,max_position_error_m,"
                       "energy_balance_error_j,energy_balance_relative,tail_peak_to_peak_m,"
                       "tail_peak_to_peak_relative_error,verdict,verdict_agrees,diverged_at_tick"
                       "\n\"a, \"\"b\"\"\xff\",none,5,5000,oscillating,5e-04,,exact,,7,1,29000,"),
            HasSubstr(",0,-1,settled,false,\n"),
            HasSubstr(",rk4,1000,,,,,,,,,diverged,false,12\n")));
}

}  // namespace
}  // namespace hapticwall::study::accuracy
