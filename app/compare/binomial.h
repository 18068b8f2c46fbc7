// How much a number of choices between two says: exact, for any number of them.
#pragma once

#include <cstdint>

namespace hapticwall::runtime {

struct Proportion {
  double share = 0.0;  // k/n; 0 without a trial
  double low = 0.0;    // of the confidence interval
  double high = 1.0;
};

// P(X >= k) of n trials with chance p each. p in [0, 1]; 1 for k = 0, 0 for k > n.
[[nodiscard]] double binomial_at_least(std::uint32_t k, std::uint32_t n, double p);

// The exact interval of Clopper and Pearson [lit, Biometrika 26 (1934)]: every chance under which
// neither "k or more" nor "k or less" has a probability below (1 - confidence)/2. Precondition:
// k <= n, confidence in (0, 1). Without a trial it is all of [0, 1].
[[nodiscard]] Proportion clopper_pearson(std::uint32_t k, std::uint32_t n, double confidence);

// The exact two-sided p-value of k of n against a chance of one half. 1 without a trial.
[[nodiscard]] double binomial_two_sided(std::uint32_t k, std::uint32_t n);

}  // namespace hapticwall::runtime
