// What the answers of blind trials show.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/compare/binomial.h"
#include "app/compare/blind_trials.h"

namespace hapticwall::compare {

struct TrialResult {
  std::uint32_t trials = 0;  // answered
  std::uint32_t chose_a = 0;
  std::uint32_t chose_first = 0;  // far from one half, the order was judged
  std::uint32_t judged = 0;       // with a right answer
  std::uint32_t correct = 0;      // of these
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
