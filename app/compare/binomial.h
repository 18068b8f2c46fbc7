// Exact binomial statistics of choices between two.
#pragma once

#include <cstdint>

namespace hapticwall::compare {

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

}  // namespace hapticwall::compare
