// Set-up mathematics of the exact integrator: one matrix exponential per scene, and exact integrals
// of quadratic forms along the motion (Van Loan 1978), in extended precision.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace hapticwall {

using SetupMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

// A step of 2^-n, n the index in the list that make_propagators() gives.
struct Propagator {
  SetupMatrix increment;               // e^{A h} - 1, without the cancellation of that difference
  std::vector<SetupMatrix> integrals;  // ∫_0^h e^{Aᵀt} S e^{At} dt, symmetric, one per weight S
};

// `generator`: A of dy/dt = A y, square, time measured in ticks. `weights`: symmetric matrices of
// the same size. Gives the whole tick (first) and its `halvings` halves of halves.
//
// The shortest step, or a still shorter one with |A| h ≤ 1/2, is taken with Eigen's Padé
// approximant and doubled: E(2h) = 2E + E², G(2h) = G + ΦᵀGΦ. Nothing grows on the way, however
// stiff A is, and near-singular or critically damped matrices are nothing special. Realtime-safe:
// no.
[[nodiscard]] std::vector<Propagator> make_propagators(const SetupMatrix& generator,
                                                       std::span<const SetupMatrix> weights,
                                                       int halvings);

}  // namespace hapticwall
