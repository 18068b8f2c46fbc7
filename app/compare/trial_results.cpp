#include "app/compare/trial_results.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/scene_keys.h"
#include "core/text.h"

namespace hapticwall::compare {
namespace {

void count(TrialResult& result, const file::Answer& answer) {
  ++result.trials;
  result.chose_a += answer.chosen == Slot::kA ? 1U : 0U;
  result.chose_first += answer.chosen == answer.first ? 1U : 0U;
  result.judged += answer.correct ? 1U : 0U;
  result.correct += answer.correct.value_or(false) ? 1U : 0U;
}

void judge(TrialResult& result, double confidence) {
  result.a = clopper_pearson(result.chose_a, result.trials, confidence);
  result.p_value = binomial_two_sided(result.chose_a, result.trials);
}

PairResult& pair_of(std::vector<PairResult>& pairs, const file::Answer& answer) {
  const auto found = std::ranges::find_if(pairs, [&](const PairResult& pair) {
    return pair.kind == answer.kind && pair.question == answer.question && pair.a == answer.a &&
           pair.b == answer.b;
  });
  if (found != pairs.end()) return *found;
  pairs.push_back({answer.kind, answer.question, answer.a, answer.b, {}});
  return pairs.back();
}

}  // namespace

TrialResults results_of(std::span<const file::Answer> answers, double confidence) {
  TrialResults results;
  for (const file::Answer& answer : answers) {
    if (answer.kind == file::TrialKind::kPractice) {
      ++results.practice;
      continue;
    }
    count(answer.kind == file::TrialKind::kTest ? results.tests : results.catches, answer);
    count(pair_of(results.pairs, answer).result, answer);
  }
  judge(results.tests, confidence);
  judge(results.catches, confidence);
  for (PairResult& pair : results.pairs) judge(pair.result, confidence);
  return results;
}

std::string result_csv(const BlindTrials& trials, const TrialResults& results) {
  std::string text =
      "question,seed,a,b,planned_trials,trials,chose_a,chose_first,share_a,confidence,share_a_low,"
      "share_a_high,p_value\n";
  for (const PairResult& pair : results.pairs) {
    const TrialResult& result = pair.result;
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(pair.question), trials.plan().seed,
        csv_field(pair.a), csv_field(pair.b), trials.planned(), result.trials, result.chose_a,
        result.chose_first, number_text(result.a.share), number_text(trials.plan().confidence),
        number_text(result.a.low), number_text(result.a.high), number_text(result.p_value));
  }
  return text;
}

}  // namespace hapticwall::compare
