// Evaluation of the answers of blind trials.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/compare/blind_trials.h"

namespace hapticwall::compare {

// Exact binomial statistics of choices between two.
struct Proportion {
  double share = 0.0;  // k/n; 0 without a trial
  double low = 0.0;    // lower bound of the confidence interval
  double high = 1.0;
};

// P(X >= k) of n trials with chance p each. p in [0, 1]; 1 for k = 0, 0 for k > n.
[[nodiscard]] double binomial_at_least(std::uint32_t k, std::uint32_t n, double p);

// Exact Clopper-Pearson interval [lit, Biometrika 26 (1934)]: all probabilities under which neither
// "k or more" nor "k or less" has a probability below (1 - confidence)/2. Preconditions: k <= n,
// confidence in (0, 1). [0, 1] without trials.
[[nodiscard]] Proportion clopper_pearson(std::uint32_t k, std::uint32_t n, double confidence);

struct TrialResult {
  std::uint32_t trials = 0;  // answered
  std::uint32_t chose_a = 0;
  std::uint32_t chose_first = 0;  // far from one half, the order was judged
  std::uint32_t judged = 0;       // trials with a right answer
  std::uint32_t correct = 0;      // right answers among the judged trials
  Proportion a;                   // the share of A, with its exact interval
};

// A point of the psychometric function: equal trials.
struct PairResult {
  file::TrialKind kind = file::TrialKind::kTest;
  std::string question;
  std::string a;
  std::string b;
  TrialResult result;
};

struct TrialResults {
  TrialResult tests;
  TrialResult catches;
  std::uint32_t practice = 0;     // answered, not counted
  std::vector<PairResult> pairs;  // in the order of their first answers, without practice
};

[[nodiscard]] TrialResults results_of(std::span<const file::Answer> answers, double confidence);

}  // namespace hapticwall::compare
