// The energy bounding algorithm of the paper.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// F_d(k) = F_d(k-1) + clamp(F_e - F_d(k-1), ±b|v_k|)   where v_k ≠ 0,
//          F_d(k-1) + clamp(F_e - F_d(k-1), ±α_max)    where the encoder shows no motion.
//
// Source: paper, Eq. 20-22; as published, written without the division by v_k, which would overflow
// for a tiny velocity. Invariant: energy_hold ≥ energy_budget at every row, because each row adds
// (F_d(k-1) - F_d(k)) Δx_k ≥ -b|v_k||Δx_k| = -T b v_k². It bounds the hold only: the lag of F_d
// behind F_e can make the control law itself active (docs/physics.md). Realtime-safe: yes.
class EnergyBounding {
 public:
  static constexpr std::array<ParameterDescription, 2> kParameters{
      kBelievedDampingParameter,
      ParameterDescription{"rest_force_step_n",
                           ParameterKind::kNumber,
                           "N",
                           0.0,
                           1e6,
                           {},
                           "b Δ/T with an encoder, no limit without",
                           "α_max: the largest change of force in a tick without measured motion"}};
  static constexpr AlgorithmDescription kDescription{
      "energy-bounding", "Energy bounding",
      "limits the change of force in a tick to what the device's damping can dissipate",
      kParameters, "F_d(k) = F_d(k-1) + (F_e - F_d(k-1)) within ±b|v|, within ±α_max where v = 0"};

  // α_max, named or by default. The largest motion that one count hides is Δ a tick: b Δ/T. Without
  // an encoder v_k = 0 means rest, and the paper needs no bound.
  [[nodiscard]] static double rest_force_step(const StabiliserContext& context) {
    const double hidden_n = context.encoder_m > 0.0
                                ? believed_damping(context) * context.encoder_m / context.period_s
                                : std::numeric_limits<double>::max();
    return context.value_or("rest_force_step_n", hidden_n);
  }

  void configure(const StabiliserContext& context) {
    damping_n_s_per_m_ = believed_damping(context);
    rest_force_step_n_ = rest_force_step(context);
  }
  void reset() {}

  [[nodiscard]] double step(const StabiliserInput& input) {
    const double bound_n = input.velocity_m_per_s != 0.0
                               ? damping_n_s_per_m_ * std::abs(input.velocity_m_per_s)
                               : rest_force_step_n_;
    const double wanted_step_n = input.wall_force_n - input.previous_force_n;
    // Where the bound does not bind, F_d is F_e itself and not F_e up to rounding.
    if (std::abs(wanted_step_n) <= bound_n) return input.wall_force_n;
    return input.previous_force_n + std::copysign(bound_n, wanted_step_n);
  }

 private:
  double damping_n_s_per_m_ = 0.0;
  double rest_force_step_n_ = 0.0;
};

}  // namespace hapticwall
