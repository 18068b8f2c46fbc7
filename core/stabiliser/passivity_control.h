// Time-domain passivity control of Hannaford and Ryu: an observer and a damper that answers it.
#pragma once

#include <array>
#include <string_view>

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// The observer sums the energy that went into the virtual wall; where it would fall below what is
// tolerated, a damper takes back what is missing:
//
//   W = E(k-1) + F_e(k) Δx_k      (observer "same-sample": Hannaford & Ryu 2002; paper, Eq. 6)
//   W = E(k-1) + F_d(k-1) Δx_k    (observer "held-force":  Ryu et al. 2004; paper, Eq. 10)
//   W < -credit, |v_k| > floor:   α = min((-credit - W)/(T v_k²), α_max),  F_d = F_e + α v_k
//   else                          F_d = F_e;      E follows the force really applied.
//
// With "same-sample" the observer is blind to the hold: on a spring wall W is never negative
// [paper, Eq. 12] and the controller never acts (the paper's Figure 4 (c)).
// Source: Hannaford & Ryu 2002 and Ryu et al. 2004, formulas reconstructed.
// Realtime-safe: yes. The quotient is taken only where it is at most α_max|v|: it cannot overflow.
class PassivityControl {
 public:
  static constexpr std::array<std::string_view, 2> kObservers{"same-sample", "held-force"};
  static constexpr std::array<ParameterDescription, 6> kParameters{
      kBelievedDampingParameter,
      ParameterDescription{"observer", ParameterKind::kChoice, "", 0.0, 1.0, kObservers,
                           "same-sample",
                           "which force the observer pairs with the motion of a tick"},
      ParameterDescription{"damping_credit",
                           ParameterKind::kBoolean,
                           "",
                           0.0,
                           1.0,
                           {},
                           "false",
                           "tolerate what the device's damping eats: act below -b T Σ v² only"},
      ParameterDescription{"reset_in_free_motion",
                           ParameterKind::kBoolean,
                           "",
                           0.0,
                           1.0,
                           {},
                           "false",
                           "forget the observed energy while the handle is out of the wall"},
      ParameterDescription{"max_damping_n_s_per_m",
                           ParameterKind::kNumber,
                           "N·s/m",
                           0.0,
                           1e6,
                           {},
                           "b, the largest damper that the hold renders passively",
                           "α_max: the largest damper that the controller may inject"},
      ParameterDescription{"velocity_floor_m_per_s",
                           ParameterKind::kNumber,
                           "m/s",
                           0.0,
                           1e3,
                           {},
                           "0",
                           "no action at or below this measured speed"}};
  static constexpr AlgorithmDescription kDescription{
      "passivity-control", "Passivity control",
      "watches the energy that the wall returns and damps the handle when it is too much",
      kParameters, "W = E(k-1) + F_e Δx;  F_d = F_e + α v where W < 0,  α = min(-W/(T v²), α_max)"};

  // The largest damping that it injects, named or by default: b, because b ≥ K T/2 + B with K = 0
  // [paper, Eq. 18].
  [[nodiscard]] static double max_damping(const StabiliserContext& context) {
    return context.value_or("max_damping_n_s_per_m", believed_damping(context));
  }

  void configure(const StabiliserContext& context);
  void reset();
  [[nodiscard]] double step(const StabiliserInput& input);

 private:
  [[nodiscard]] double damping_force(const StabiliserInput& input, double deficit_j) const;

  bool held_force_ = false;
  bool damping_credit_ = false;
  bool reset_in_free_motion_ = false;
  double period_s_ = 1e-3;
  double damping_n_s_per_m_ = 0.0;
  double max_damping_n_s_per_m_ = 0.0;
  double velocity_floor_m_per_s_ = 0.0;

  double observed_j_ = 0.0;              // E
  double credit_j_ = 0.0;                // b T Σ v²
  double pending_displacement_m_ = 0.0;  // Δx of the last tick, whose force is known only now
};

}  // namespace hapticwall
