// The force bounding approach: no force that the next move could turn into energy out of nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// E is what the handle has given to the actuator and what the device's damping has eaten meanwhile,
//
//   E(k) = E(k-1) + (b/T) Δx_k² + F_d(k-1) Δx_k,   E(k-1) forgotten where F_d(k-1) = 0,
//   F_d(k) = sgn(F_e) min(|F_e|, √(4 (b/T) E(k))).
//
// The next move costs at most F_d²T/(4b), at Δx = -F_d T/(2b), so that E never falls below zero
// whatever the next move is: passive as the encoder sees it, hold and control law together. Where
// no force acts, nothing is owed, and what was gathered in free motion is not lent to a contact.
// Displays about 2b/T.
//
// Source: after Kim, Baek & Ryu, "A force bounding approach for multi-degree-of-freedom haptic
// interaction", IEEE/ASME Trans. Mechatronics 20(3), 2015; this form derived. Realtime-safe: yes.
class ForceBounding {
 public:
  static constexpr std::array<ParameterDescription, 1> kParameters{kBelievedDampingParameter};
  static constexpr AlgorithmDescription kDescription{
      "force-bounding", "Force bounding",
      "gives no more force than what was gathered can pay, whatever the next move is", kParameters,
      "E(k) = E(k-1) + (b/T) Δx² + F_d(k-1) Δx,  E(k-1) = 0 where F_d(k-1) = 0,\n"
      "F_d(k) = sgn(F_e) min(|F_e|, √(4 (b/T) E))"};

  // b/T.
  [[nodiscard]] static double damping_per_period(const StabiliserContext& context) {
    return believed_damping(context) / context.period_s;
  }

  void configure(const StabiliserContext& context) {
    damping_n_per_m_ = damping_per_period(context);
  }
  void reset() { energy_j_ = 0.0; }

  [[nodiscard]] double step(const StabiliserInput& input) {
    if (input.previous_force_n == 0.0) energy_j_ = 0.0;
    energy_j_ = energy_j_ + damping_n_per_m_ * (input.displacement_m * input.displacement_m) +
                input.previous_force_n * input.displacement_m;
    // Below zero by rounding only, and where b is told anew in the course of a contact.
    const double bound_n = std::sqrt(4.0 * damping_n_per_m_ * std::max(energy_j_, 0.0));
    return std::copysign(std::min(std::abs(input.wall_force_n), bound_n), input.wall_force_n);
  }

 private:
  double damping_n_per_m_ = 0.0;
  double energy_j_ = 0.0;  // E
};

}  // namespace hapticwall
