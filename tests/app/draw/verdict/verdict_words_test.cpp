#include "app/draw/verdict/verdict_words.h"

#include <gtest/gtest.h>

namespace hapticwall::draw {
namespace {

struct Case {
  Verdict verdict;
  const char* numbers;
  const char* more;
  Tone tone;
};

TEST(VerdictWords, TellTheVerdictInTheUnitsOfTheField) {
  Tail tail;
  EXPECT_EQ(verdict_words(tail).word, "waiting");
  tail.end_tick = 1000;
  tail.frequency_hz = 49.98;
  Summary& s = tail.summary;
  s.tail_peak_to_peak_m = 2.83e-3;
  s.tail_force_mean_n = 4.94;
  s.tail_force_std_n = 4.39;
  s.displayed_stiffness_n_per_m = 30120.0;
  s.given_w = 0.0124;
  for (const Case& each :
       {Case{Verdict::kOscillating, "2.8 mm at 50 Hz", "4.9 ± 4.4 N", Tone::kBad},
        Case{Verdict::kBuzzing, "30 kN/m", "4.9 ± 4.4 N at 50 Hz", Tone::kWarning},
        Case{Verdict::kSettled, "30 kN/m", "4.9 N, still", Tone::kGood},
        Case{Verdict::kMoving, "30 kN/m", "4.9 N, the hand moves", Tone::kGood},
        Case{Verdict::kActive, "30 kN/m", "gives the hand 12 mW", Tone::kWarning},
        Case{Verdict::kNoContact, "", "", Tone::kText},
        Case{Verdict::kDiverged, "", "", Tone::kBad}}) {
    s.verdict = each.verdict;
    const VerdictWords words = verdict_words(tail);
    SCOPED_TRACE(words.word);
    EXPECT_EQ(words.numbers, each.numbers);
    EXPECT_EQ(words.more, each.more);
    EXPECT_EQ(words.tone, each.tone);
    EXPECT_EQ(edge_tone(tail).value_or(Tone::kText), each.tone);
  }
}

TEST(VerdictWords, HaveTwoDigitsOfSmallNumbersAndAllOfLargeOnes) {
  Tail tail;
  tail.end_tick = 1;
  tail.summary.tail_peak_to_peak_m = 0.0;
  tail.summary.verdict = Verdict::kMoving;
  for (const auto& [n_per_m, text] :
       {std::pair{350.0, "350 N/m"}, std::pair{1904.0, "1.9 kN/m"}, std::pair{9960.0, "10 kN/m"},
        std::pair{0.123, "0.12 N/m"}, std::pair{160400.0, "160 kN/m"}}) {
    tail.summary.displayed_stiffness_n_per_m = n_per_m;
    EXPECT_EQ(verdict_words(tail).numbers, text);
  }
}

}  // namespace
}  // namespace hapticwall::draw
