#include "app/file/text/verdict.h"

#include <gtest/gtest.h>

namespace hapticwall::file {
namespace {

TEST(VerdictWords, ADivergedRunNamesItsTick) {
  Summary summary;
  EXPECT_EQ(verdict_text(summary), "settled");
  summary.verdict = Verdict::kDiverged;
  EXPECT_EQ(verdict_text(summary), "diverged");
  summary.diverged_at_tick = 12;
  EXPECT_EQ(verdict_text(summary), "diverged at tick 12");
}

TEST(VerdictWords, TheGradeNeverFallsFromOneVerdictToTheNext) {
  for (std::size_t i = 1; i < kVerdictNames.size(); ++i) {
    EXPECT_GE(grade_of(static_cast<Verdict>(i)), grade_of(static_cast<Verdict>(i - 1)));
  }
  EXPECT_EQ(grade_of(Verdict::kSettled), VerdictGrade::kGood);
  EXPECT_EQ(grade_of(Verdict::kBuzzing), VerdictGrade::kWarning);
  EXPECT_EQ(grade_of(Verdict::kOscillating), VerdictGrade::kBad);
}

TEST(VerdictWords, TheLastSecondSaysWhetherThereIsContact) {
  Summary summary;
  summary.tail_peak_to_peak_m = 0.002;
  summary.tail_force_mean_n = 0.1;
  summary.tail_force_std_n = 0.7071;
  const TailTexts free = tail_texts(summary);
  EXPECT_EQ(free.way, "2.000 mm p-p");
  EXPECT_EQ(free.force, "0.100 ± 0.707 N");
  EXPECT_EQ(free.stiffness, "no contact");
  summary.displayed_stiffness_n_per_m = 1250.0;
  EXPECT_EQ(tail_texts(summary).stiffness, "1.25 kN/m");
  EXPECT_EQ(tail_texts({}).way, "- mm p-p");
}

}  // namespace
}  // namespace hapticwall::file
