// The force bounding approach: every force is covered by the energy that the contact has gathered.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/algorithm/algorithm.h"

namespace hapticwall {

// E is what the handle has given to the actuator plus what the device's damping has dissipated,
//
//   E(k) = E(k-1) + (b/T) Δx_k² + F_d(k-1) Δx_k,   E(k-1) forgotten where F_d(k-1) = 0,
//   F_d(k) = sgn(F_e) min(|F_e|, √(4 (b/T) E(k))).
//
// The next move costs at most F_d²T/(4b), at Δx = -F_d T/(2b), so E never falls below zero. The
// hold and the control law together are passive as the encoder sees them. Forgetting E without a
// force keeps energy of free motion out of the next contact. Displays about 2b/T.
//
// Source: Kim, Baek & Ryu, "A force bounding approach for multi-degree-of-freedom haptic
// interaction", IEEE/ASME Trans. Mechatronics 20(3), 2015; formula reconstructed. It agrees with a
// public implementation for several degrees of freedom (docs/algorithms/force-bounding.md).
struct ForceBounding {
  static constexpr std::array<ParameterDescription, 1> kParameters{kBelievedDampingParameter};
  static constexpr std::array<SignalDescription, 2> kSignals{
      {{"gathered_energy_j", "the energy that the contact has gathered"},
       {"force_bound_n", "the largest force that it allows"}}};
  static constexpr AlgorithmDescription kDescription{
      "force-bounding",
      "Force bounding",
      "gives no more force than what was gathered can pay, whatever the next move is",
      kParameters,
      "E(k) = E(k-1) + (b/T) Δx² + F_d(k-1) Δx,  E(k-1) = 0 where F_d(k-1) = 0,\n"
      "F_d(k) = sgn(F_e) min(|F_e|, √(4 (b/T) E))",
      kSignals};

  void configure(const AlgorithmContext& context) {
    damping_n_per_m_ = believed_damping(context) / context.period_s;
  }
  void reset() { energy_j_ = 0.0; }

  double step(const AlgorithmInput& in, std::span<double> signals) {
    if (in.previous_force_n == 0.0) energy_j_ = 0.0;
    energy_j_ = energy_j_ + damping_n_per_m_ * (in.displacement_m * in.displacement_m) +
                in.previous_force_n * in.displacement_m;
    // E is negative only by rounding, or after a change of b during a contact.
    const double bound_n = std::sqrt(4.0 * damping_n_per_m_ * std::max(energy_j_, 0.0));
    signals[0] = energy_j_;
    signals[1] = bound_n;
    return std::copysign(std::min(std::abs(in.wall_force_n), bound_n), in.wall_force_n);
  }

 private:
  double damping_n_per_m_ = 0.0;  // b/T
  double energy_j_ = 0.0;         // E
};

}  // namespace hapticwall
