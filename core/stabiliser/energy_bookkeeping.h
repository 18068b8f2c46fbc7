// Energy bookkeeping: the wall gives back only what the contact has put into it.
#pragma once

#include <array>

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// H is the exact energy that the contact has put in (Eq. 10 since the contact began), and the force
// is that of the wall's own springs when they hold that energy, but never less than that of the
// spring which b makes passive by itself:
//
//   H(k) = H(k-1) + F_d(k-1) Δx_k,   0 out of contact,
//   F_d(k) = min(F_e, max((2b/T) p_k, √(2K max(H, 0)))).
//
// With several walls √(2K H) becomes the force at which all their springs together hold H. A
// deficit of H stays in the book until the contact ends. What it comes to is bounded: on a wall
// without damping, with P the deepest penetration of the contact so far and κ = 2b/T,
//
//   H(k) ≥ -(b/T) Σ Δx² - (max(κ, K/2) + κ/2) P²,
//
// because one retreat from H ≥ 0 takes at most max(κ, K/2) P², and the passive spring from then on
// costs no more than the damping eats and ½κP². That is a bound, not passivity: with K > 2b/T a
// quick retreat gets more than was put in. Displays about 2b/T.
//
// Source: after Stramigioli, Secchi, van der Schaft & Fantuzzi, "Sampled data systems passivity and
// discrete port-Hamiltonian systems", IEEE Trans. Robotics 21(4), 2005 (paper, ref. 17); this form
// derived. Realtime-safe: yes.
class EnergyBookkeeping {
 public:
  static constexpr std::array<ParameterDescription, 1> kParameters{kBelievedDampingParameter};
  static constexpr AlgorithmDescription kDescription{
      "energy-bookkeeping", "Energy bookkeeping",
      "keeps the book of the contact's energy and gives the spring force that it allows",
      kParameters,
      "H(k) = H(k-1) + F_d(k-1) Δx,  0 out of contact,\n"
      "F_d(k) = min(F_e, max((2b/T) p, √(2 K max(H, 0))))"};

  // 2b/T, the stiffness of the always-passive spring.
  [[nodiscard]] static double passive_stiffness(const StabiliserContext& context) {
    return 2.0 * believed_damping(context) / context.period_s;
  }

  void configure(const StabiliserContext& context);
  void reset() { energy_j_ = 0.0; }
  [[nodiscard]] double step(const StabiliserInput& input);

 private:
  // Of the walls when their springs hold this energy, ≥ 0.
  [[nodiscard]] double spring_force(double energy_j) const;

  WallSet walls_;
  double passive_n_per_m_ = 0.0;
  double energy_j_ = 0.0;  // H
};

}  // namespace hapticwall
