// The force bounding approach: every force is covered by the energy that the contact has gathered.
#include "core/stabiliser/law.h"

HAPTICWALL_LAW_BEGIN

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
  static constexpr bool kOnlyPushes = true;

  template <class N>
  struct Parameters {
    N damping_n_per_m;  // b/T
  };
  template <class N>
  struct State {
    N energy_j;  // E
  };

  static Parameters<double> parameters(const StabiliserContext& context) {
    return {believed_damping(context) / context.period_s};
  }

  static Number step(const Parameters<Number>& p, State<Number>& s, const Walls& /*walls*/,
                     const LawInput& in) {
    s.energy_j = or_zero(differs(in.previous_force_n, number(0.0)), s.energy_j);
    s.energy_j = s.energy_j + p.damping_n_per_m * (in.displacement_m * in.displacement_m) +
                 in.previous_force_n * in.displacement_m;
    return smaller(in.wall_force_n, bound(p, s));  // F_e ≥ 0: a wall never pulls
  }

  static std::array<Number, 2> signals(const Parameters<Number>& p, const State<Number>& s,
                                       const Walls& /*walls*/, const LawInput& /*in*/,
                                       Number /*force_n*/) {
    return {s.energy_j, bound(p, s)};
  }

 private:
  // E is negative only by rounding, or after a change of b during a contact.
  static Number bound(const Parameters<Number>& p, const State<Number>& s) {
    return root(number(4.0) * p.damping_n_per_m * larger(s.energy_j, number(0.0)));
  }
};

HAPTICWALL_LAW_END
