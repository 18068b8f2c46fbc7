// Energy-limited spring: the wall gives back only what the contact has put into it.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/algorithm/algorithm.h"
#include "core/environment/active_environment.h"

namespace hapticwall {

// H is the exact energy that the contact has put in (Eq. 10 since the contact began). The force is
// that of the wall's springs when they hold H, and at least that of the spring that b alone keeps
// passive:
//
//   H(k) = H(k-1) + F_d(k-1) Δx_k,   0 out of contact,
//   F_d(k) = min(F_e, max((2b/T) p_k, √(2K max(H, 0)))).
//
// With several walls √(2K H) becomes the force at which all their springs together hold H. A
// deficit of H stays in the book until the contact ends. On a wall without damping it is bounded:
// with P the deepest penetration of the contact so far and κ = 2b/T,
//
//   H(k) ≥ -(b/T) Σ Δx² - (max(κ, K/2) + κ/2) P²,
//
// because one retreat from H ≥ 0 takes at most max(κ, K/2) P², and from then on the passive spring
// costs no more than the damping dissipates plus ½κP². This bound is weaker than passivity: with
// K > 2b/T a quick retreat gets more than was put in. Displays about 2b/T.
//
// Source: derived. The exact account of the hold is that of Stramigioli, Secchi, van der Schaft &
// Fantuzzi, "Sampled data systems passivity and discrete port-Hamiltonian systems", IEEE Trans.
// Robotics 21(4), 2005 (paper, ref. 17); their controller is another one.
struct EnergyLimitedSpring {
  static constexpr std::array<ParameterDescription, 1> kParameters{kBelievedDampingParameter};
  // Those of force-bounding.
  static constexpr std::array<SignalDescription, 2> kSignals{
      {{"gathered_energy_j", "the energy that the contact has gathered"},
       {"force_bound_n", "the largest force that it allows"}}};
  static constexpr AlgorithmDescription kDescription{
      "energy-limited-spring",
      "Energy-limited spring",
      "keeps the book of the contact's energy and gives the spring force that it allows",
      kParameters,
      "H(k) = H(k-1) + F_d(k-1) Δx,  0 out of contact,\n"
      "F_d(k) = min(F_e, max((2b/T) p, √(2 K max(H, 0))))",
      kSignals,
      nullptr,
      "energy-bookkeeping",
      "",
      nullptr,
      true};

  void configure(const AlgorithmContext& context) {
    passive_n_per_m_ = 2.0 * believed_damping(context) / context.period_s;
    walls_ = context.walls;
  }
  void reset() { energy_j_ = 0.0; }

  double step(const AlgorithmInput& in, std::span<double> signals) {
    energy_j_ = in.in_contact ? energy_j_ + in.previous_force_n * in.displacement_m : 0.0;
    if (in.environment != nullptr) return force_of_environment(*in.environment, in, signals);
    const double spring_n = spring_force(walls_, std::max(energy_j_, 0.0));
    const double bound_n = std::max(passive_n_per_m_ * in.penetration_m, spring_n);
    signals[0] = energy_j_;
    signals[1] = bound_n;
    return std::min(in.wall_force_n, bound_n);
  }

 private:
  // The environment counts as a spring of its stiffness hint K: p = |F_e|/K, in either direction.
  [[nodiscard]] double force_of_environment(const ActiveEnvironment& environment,
                                            const AlgorithmInput& in,
                                            std::span<double> signals) const {
    const double stiffness_n_per_m = environment.stiffness_hint();
    if (!(stiffness_n_per_m > 0.0)) return 0.0 * stiffness_n_per_m;  // NaN if it is unknown
    const double wanted_n = std::abs(in.wall_force_n);
    const double spring_n = std::sqrt(2.0 * stiffness_n_per_m * std::max(energy_j_, 0.0));
    const double bound_n = std::max(passive_n_per_m_ * (wanted_n / stiffness_n_per_m), spring_n);
    signals[0] = energy_j_;
    signals[1] = bound_n;
    return std::copysign(std::min(wanted_n, bound_n), in.wall_force_n);
  }

  double passive_n_per_m_ = 0.0;  // 2b/T
  double energy_j_ = 0.0;         // H
  WallSet walls_;
};

}  // namespace hapticwall
