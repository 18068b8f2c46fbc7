#include "core/plant/propagator.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

namespace hapticwall {
namespace {

long double row_sum_norm(const SetupMatrix& matrix) {
  return matrix.cwiseAbs().rowwise().sum().maxCoeff();
}

// e^A - 1 for a small A: the upper right block of exp [A A; 0 0].
SetupMatrix small_increment(const SetupMatrix& a) {
  const Eigen::Index n = a.rows();
  SetupMatrix block = SetupMatrix::Zero(2 * n, 2 * n);
  block.topLeftCorner(n, n) = a;
  block.topRightCorner(n, n) = a;
  const SetupMatrix exponential = block.exp();
  return exponential.topRightCorner(n, n);
}

// ∫_0^h e^{Aᵀt} S e^{At} dt for a small A h, from exp([-Aᵀ S; 0 A] h) (Van Loan 1978). The weight
// is scaled so that its block is as large as the others.
SetupMatrix small_integral(const SetupMatrix& a, const SetupMatrix& weight, long double step) {
  const Eigen::Index n = a.rows();
  const long double size = row_sum_norm(weight);
  if (!(size > 0.0L)) return SetupMatrix::Zero(n, n);
  SetupMatrix block = SetupMatrix::Zero(2 * n, 2 * n);
  block.topLeftCorner(n, n) = -a.transpose();
  block.topRightCorner(n, n) = weight / size;
  block.bottomRightCorner(n, n) = a;
  const SetupMatrix exponential = block.exp();
  const SetupMatrix transition = exponential.bottomRightCorner(n, n);
  const SetupMatrix upper = exponential.topRightCorner(n, n);
  const SetupMatrix integral = transition.transpose() * upper * (size * step);
  return (integral + integral.transpose()) / 2.0L;
}

Propagator doubled(const Propagator& half) {
  const SetupMatrix& e = half.increment;
  Propagator whole;
  whole.increment = 2.0L * e + e * e;
  for (const SetupMatrix& g : half.integrals) {
    const SetupMatrix ge = g * e;
    whole.integrals.emplace_back(2.0L * g + ge + ge.transpose() + e.transpose() * ge);
  }
  return whole;
}

}  // namespace

std::vector<Propagator> make_propagators(const SetupMatrix& generator,
                                         std::span<const SetupMatrix> weights, int halvings) {
  constexpr long double kSmallNorm = 0.5L;
  const long double norm = row_sum_norm(generator);
  const int for_accuracy =
      norm > kSmallNorm ? static_cast<int>(std::ceil(std::log2(norm / kSmallNorm))) : 0;
  const int deepest = std::max(halvings, for_accuracy);
  const long double step = std::ldexp(1.0L, -deepest);
  const SetupMatrix small = generator * step;

  Propagator propagator;
  propagator.increment = small_increment(small);
  for (const SetupMatrix& weight : weights) {
    propagator.integrals.push_back(small_integral(small, weight, step));
  }
  std::vector<Propagator> levels(static_cast<std::size_t>(halvings) + 1);
  for (int level = deepest;; --level) {
    if (level <= halvings) levels[static_cast<std::size_t>(level)] = propagator;
    if (level == 0) return levels;
    propagator = doubled(propagator);
  }
}

}  // namespace hapticwall
