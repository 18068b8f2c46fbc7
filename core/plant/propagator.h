// Set-up mathematics of the exact integrator: one matrix exponential per scene, and exact integrals
// of quadratic forms along the motion (Van Loan 1978), in extended precision.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace hapticwall {

using SetupMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

struct Propagator {
  SetupMatrix increment;  // e^A - 1, without the cancellation of that difference
  std::vector<SetupMatrix>
      integrals;  // ∫_0^1 e^{Aᵀt} S e^{At} dt, symmetric, one for each weight S
};

// `generator`: A of dy/dt = A y, square, time measured in steps (the step is t = 1). `weights`:
// symmetric matrices of the same size.
//
// A short step h = 2^-n with |A| h ≤ 1/2 is taken with Eigen's Padé approximant and doubled n
// times: E(2h) = 2E + E², G(2h) = G + ΦᵀGΦ. Nothing grows on the way, however stiff A is, and
// near-singular or critically damped matrices are nothing special. Realtime-safe: no.
[[nodiscard]] Propagator make_propagator(const SetupMatrix& generator,
                                         std::span<const SetupMatrix> weights);

}  // namespace hapticwall
