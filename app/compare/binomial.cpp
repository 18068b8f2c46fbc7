#include "app/compare/binomial.h"

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

}  // namespace hapticwall::compare
