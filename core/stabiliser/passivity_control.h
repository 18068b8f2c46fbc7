// Time-domain passivity control of Hannaford and Ryu: an observer and the damper that it drives.
#include <string_view>

#include "core/stabiliser/law.h"

HAPTICWALL_LAW_BEGIN

// The observer sums the energy that went into the virtual wall. When it would fall below what is
// tolerated, a damper takes back the missing part:
//
//   W = E(k-1) + F_e(k) Δx_k      (observer "same-sample": Hannaford & Ryu 2002; paper, Eq. 6)
//   W = E(k-1) + F_d(k-1) Δx_k    (observer "held-force":  Ryu et al. 2004; paper, Eq. 10)
//   W = E(k-1) + F_d(k-1) Δx_k + F_e(k) Δx_k   (observer "one-step")
//   W < -credit, |v_k| > floor:   α = min((-credit - W)/(T v_k²), α_max),  F_d = F_e + α v_k
//   else                          F_d = F_e;      E follows the force really applied.
//
// The observer "same-sample" is blind to the hold: on a spring wall W is never negative
// [paper, Eq. 12] and the controller never acts (the paper's Figure 4 (c)). The observer "one-step"
// predicts Δx_{k+1} = Δx_k and takes what the hold will then have given out.
// Source: Hannaford & Ryu 2002 and Ryu et al. 2004, formulas reconstructed; for the prediction we
// read no original. The quotient is used only where it is at most α_max|v|, so it cannot overflow.
struct PassivityControl {
  static constexpr std::array<std::string_view, 3> kObservers{"same-sample", "held-force",
                                                              "one-step"};
  static constexpr std::array<ParameterDescription, 6> kParameters{
      kBelievedDampingParameter,
      choice_parameter("observer", kObservers,
                       "which force the observer pairs with the motion of a tick"),
      switch_parameter("damping_credit",
                       "tolerate what the device's damping eats: act below -b T Σ v² only"),
      switch_parameter("reset_in_free_motion",
                       "forget the observed energy while the handle is out of the wall"),
      number_parameter("max_damping_n_s_per_m", "N·s/m", 0.0, 1e6,
                       "b, the largest damper that the hold renders passively",
                       "α_max: the largest damper that the controller may inject"),
      number_parameter("velocity_floor_m_per_s", "m/s", 0.0, 1e3, "0",
                       "no action at or below this measured speed")};
  static constexpr std::array<SignalDescription, 3> kSignals{
      {{"observed_energy_j", "W: the energy that went into the wall, by the observer"},
       {"credit_j", "b T Σ v²: how far W may be below zero"},
       {"injected_damping_n_s_per_m", "α: the damper of this tick"}}};
  static constexpr AlgorithmDescription kDescription{
      "passivity-control",
      "Passivity control",
      "watches the energy that the wall returns and damps the handle when it is too much",
      kParameters,
      "W = E(k-1) + F_e Δx;  F_d = F_e + α v where W < 0,  α = min(-W/(T v²), α_max)",
      kSignals,
      nullptr,
      "",
      "observer"};
  static constexpr bool kOnlyPushes = false;

  template <class N>
  struct Parameters {
    N damping_n_s_per_m;                     // b
    N max_damping_n_s_per_m;                 // α_max
    N velocity_floor_m_per_s;                // floor
    N observer;                              // index in kObservers
    N damping_credit, reset_in_free_motion;  // 1 or 0
  };
  template <class N>
  struct State {
    N observed_j;              // E
    N credit_j;                // b T Σ v²
    N pending_displacement_m;  // Δx of the last tick, whose force is known only now
  };

  // α_max defaults to b, because b ≥ K T/2 + B with K = 0 [paper, Eq. 18].
  static Parameters<double> parameters(const StabiliserContext& context) {
    const double damping = believed_damping(context);
    return {damping,
            context.value_or("max_damping_n_s_per_m", damping),
            context.value_or("velocity_floor_m_per_s", 0.0),
            context.value_or("observer", 0.0),
            context.value_or("damping_credit", 0.0),
            context.value_or("reset_in_free_motion", 0.0)};
  }

  static Number step(const Parameters<Number>& p, State<Number>& s, const Walls& /*walls*/,
                     const LawInput& in) {
    const Number zero = number(0.0);
    const Flags observes_hold = differs(p.observer, zero);
    // A damper α takes α T v² in a tick; T v = Δx.
    const Number energy_per_damping = abs_of(in.velocity_m_per_s * in.displacement_m);
    // The force really applied is known one tick later: both pairings take it from there.
    s.observed_j = s.observed_j + in.previous_force_n * select(observes_hold, in.displacement_m,
                                                               s.pending_displacement_m);
    s.pending_displacement_m = in.displacement_m;
    s.credit_j = s.credit_j +
                 or_zero(differs(p.damping_credit, zero), p.damping_n_s_per_m * energy_per_damping);
    const Flags remembers = either(in.in_contact, equals(p.reset_in_free_motion, zero));
    s.observed_j = or_zero(remembers, s.observed_j);
    s.credit_j = or_zero(remembers, s.credit_j);
    s.pending_displacement_m = or_zero(remembers, s.pending_displacement_m);

    const Number deficit_j = minus(s.credit_j) - energy(p, s, in);
    const Flags acts = both(greater(deficit_j, zero),
                            greater(abs_of(in.velocity_m_per_s), p.velocity_floor_m_per_s));
    if (none(acts)) return in.wall_force_n;
    const Flags capped = at_most(p.max_damping_n_s_per_m * energy_per_damping, deficit_j);
    const Number damping_n = select(capped, p.max_damping_n_s_per_m * in.velocity_m_per_s,
                                    deficit_j / in.displacement_m);
    return select(acts, in.wall_force_n + damping_n, in.wall_force_n);
  }

  static std::array<Number, 3> signals(const Parameters<Number>& p, const State<Number>& s,
                                       const Walls& /*walls*/, const LawInput& in, Number force_n) {
    const Number damping = (force_n - in.wall_force_n) / in.velocity_m_per_s;
    return {energy(p, s, in), s.credit_j,
            or_zero(differs(in.velocity_m_per_s, number(0.0)), damping)};
  }

 private:
  // W.
  static Number energy(const Parameters<Number>& p, const State<Number>& s, const LawInput& in) {
    return select(differs(p.observer, number(1.0)),
                  s.observed_j + in.wall_force_n * in.displacement_m, s.observed_j);
  }
};

HAPTICWALL_LAW_END
