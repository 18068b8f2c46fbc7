#include "app/compare/trial_results.h"

#include <algorithm>

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

}  // namespace hapticwall::compare
