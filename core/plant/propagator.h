// Set-up of the exact integrator: one matrix exponential per scene, and exact integrals of
// quadratic forms along the motion, in extended precision.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hapticwall {

template <int kSize>
using SetupMatrix = Eigen::Matrix<long double, kSize, kSize>;

// A step of 2^-n ticks, n the index in the list that make_propagators() gives.
template <int kSize, std::size_t kWeights>
struct Propagator {
  SetupMatrix<kSize> increment;  // e^{A h} - 1, without the cancellation of that difference
  SetupMatrix<kSize> integral;   // ∫_0^h e^{A t} dt
  // ∫_0^h e^{Aᵀt} S e^{At} dt, symmetric, one per weight S.
  std::array<SetupMatrix<kSize>, kWeights> integrals;
};

namespace detail {

// With |A h| ≤ 1/4 the truncation error of either series is below the last digit.
inline constexpr long double kSmallNorm = 0.25L;
inline constexpr int kIncrementTerms = 14;
inline constexpr int kIntegralTerms = 18;

// A generator and its powers are zero outside the columns of the first kCore states, so the
// products below skip the other columns.
template <int kCore, int kSize>
auto core_columns(const SetupMatrix<kSize>& matrix) {
  return matrix.template leftCols<kCore>();
}
template <int kCore, int kSize>
auto core_block(const SetupMatrix<kSize>& matrix) {
  return matrix.template topLeftCorner<kCore, kCore>();
}

// Σ (A h)^k / k! from k = 1, and h Σ (A h)^k / (k+1)! from k = 0.
template <int kCore, int kSize, std::size_t kWeights>
void take_small_step(const SetupMatrix<kSize>& small, long double step,
                     Propagator<kSize, kWeights>& propagator) {
  using Columns = Eigen::Matrix<long double, kSize, kCore>;
  Columns term = core_columns<kCore>(small);
  Columns increment = term;
  Columns integral = term / 2.0L;
  for (int k = 2; k <= kIncrementTerms; ++k) {
    term =
        (term.lazyProduct(core_block<kCore>(small)) * (1.0L / static_cast<long double>(k))).eval();
    increment += term;
    integral += term * (1.0L / static_cast<long double>(k + 1));
  }
  propagator.increment.setZero();
  propagator.increment.template leftCols<kCore>() = increment;
  propagator.integral.setIdentity();
  propagator.integral.template leftCols<kCore>() += integral;
  propagator.integral *= step;
}

// h Σ L^k(S) / (k+1)! with L(M) = (A h)ᵀM + M (A h): the series of the integral itself.
template <int kCore, int kSize>
SetupMatrix<kSize> small_integral(const SetupMatrix<kSize>& small, const SetupMatrix<kSize>& weight,
                                  long double step) {
  SetupMatrix<kSize> term = weight * step;
  SetupMatrix<kSize> sum = term;
  for (int k = 1; k < kIntegralTerms; ++k) {
    const Eigen::Matrix<long double, kSize, kCore> half =
        term.lazyProduct(core_columns<kCore>(small)) * (1.0L / static_cast<long double>(k + 1));
    term.setZero();
    term.template leftCols<kCore>() = half;
    term.template topRows<kCore>() += half.transpose();
    sum += term;
  }
  return sum;
}

template <int kCore, int kSize, std::size_t kWeights>
Propagator<kSize, kWeights> doubled(const Propagator<kSize, kWeights>& half) {
  const Eigen::Matrix<long double, kSize, kCore> e = core_columns<kCore>(half.increment);
  Propagator<kSize, kWeights> whole;
  whole.increment.setZero();
  whole.increment.template leftCols<kCore>() =
      2.0L * e + e.lazyProduct(core_block<kCore>(half.increment));
  whole.integral = 2.0L * half.integral;
  whole.integral.template leftCols<kCore>() += e.lazyProduct(core_block<kCore>(half.integral));
  for (std::size_t i = 0; i < kWeights; ++i) {
    const SetupMatrix<kSize>& g = half.integrals[i];
    const Eigen::Matrix<long double, kSize, kCore> ge = g.lazyProduct(e);
    whole.integrals[i] = 2.0L * g;
    whole.integrals[i].template leftCols<kCore>() += ge;
    whole.integrals[i].template topRows<kCore>() += ge.transpose();
    whole.integrals[i].template topLeftCorner<kCore, kCore>() += e.transpose().lazyProduct(ge);
  }
  return whole;
}

}  // namespace detail

// `generator`: A of dy/dt = A y, with time in ticks; the columns after the first kCore are zero.
// `weights`: symmetric matrices. Returns the steps of 1, 1/2, 1/4, … ticks, `halvings` + 1 of them.
//
// The shortest step, or a still shorter one with |A| h ≤ 1/4, is taken by its Taylor series and
// doubled: E(2h) = 2E + E², I(2h) = I + ΦI, G(2h) = G + ΦᵀGΦ. Errors do not grow, however stiff A
// is; near-singular and critically damped matrices need no special case. Realtime-safe: no.
template <int kCore, int kSize, std::size_t kWeights>
[[nodiscard]] std::vector<Propagator<kSize, kWeights>> make_propagators(
    const SetupMatrix<kSize>& generator, const std::array<SetupMatrix<kSize>, kWeights>& weights,
    int halvings) {
  const auto absolute = generator.cwiseAbs();
  const long double norm =
      std::max(absolute.rowwise().sum().maxCoeff(), absolute.colwise().sum().maxCoeff());
  const int for_accuracy = norm > detail::kSmallNorm
                               ? static_cast<int>(std::ceil(std::log2(norm / detail::kSmallNorm)))
                               : 0;
  const int deepest = std::max(halvings, for_accuracy);
  const long double step = std::ldexp(1.0L, -deepest);
  const SetupMatrix<kSize> small = generator * step;

  Propagator<kSize, kWeights> propagator;
  detail::take_small_step<kCore>(small, step, propagator);
  for (std::size_t i = 0; i < kWeights; ++i) {
    propagator.integrals[i] = detail::small_integral<kCore>(small, weights[i], step);
  }
  std::vector<Propagator<kSize, kWeights>> levels(static_cast<std::size_t>(halvings) + 1);
  for (int level = deepest;; --level) {
    if (level <= halvings) levels[static_cast<std::size_t>(level)] = propagator;
    if (level == 0) return levels;
    propagator = detail::doubled<kCore>(propagator);
  }
}

}  // namespace hapticwall
