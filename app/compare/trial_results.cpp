#include "app/compare/trial_results.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::compare {
namespace {

// The p at which `rises` changes from false to true, to the last digit.
template <typename Rises>
double crossing(const Rises& rises) {
  constexpr int kHalvings = 1100;  // enough for the smallest double
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (rises(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

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

double binomial_at_least(std::uint32_t k, std::uint32_t n, double p) {
  if (k == 0) return 1.0;
  if (k > n || p <= 0.0) return 0.0;
  if (p >= 1.0) return 1.0;
  // Sums terms from the logarithm of the first one, because p^n may underflow.
  const double log_odds = std::log(p) - std::log1p(-p);
  double log_term = n * std::log1p(-p);
  double sum = 0.0;
  for (std::uint32_t i = 0; i <= n; ++i) {
    if (i >= k) sum += std::exp(log_term);
    log_term += std::log(static_cast<double>(n - i) / static_cast<double>(i + 1)) + log_odds;
  }
  return std::min(sum, 1.0);
}

Proportion clopper_pearson(std::uint32_t k, std::uint32_t n, double confidence) {
  Proportion result;
  if (n == 0) return result;
  const double tail = 0.5 * (1.0 - confidence);
  result.share = static_cast<double>(k) / static_cast<double>(n);
  if (k > 0) {
    result.low = crossing([&](double p) { return binomial_at_least(k, n, p) >= tail; });
  }
  if (k < n) {
    // P(X <= k) is P(n - X >= n - k), with the chance of the other side.
    result.high = 1.0 - crossing([&](double q) { return binomial_at_least(n - k, n, q) >= tail; });
  }
  return result;
}

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
