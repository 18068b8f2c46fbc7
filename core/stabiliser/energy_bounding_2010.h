// The second energy bounding algorithm: it makes the control law passive, too.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// Where the encoder shows motion, the force follows F_e as far as two bounds let it:
//
//   |F_d(k) - F_d(k-1)| ≤ c₁|Δx_k|                              c₁ = b/T: the hold, as in Eq. 20-22
//   F_d(k) Δx_k ≥ (F_d(k)² - F_d(k-1)²)/(2c₂)                   0 < c₂ ≤ c₁: the control law
//
// and is held where it shows none. The second says that the law pays what it gives out from a store
// of F²/(2c₂). In β = (F_d(k) - F_d(k-1))/Δx_k, with r = F_d(k-1)/Δx_k, both are
//
//   max(-c₁, γ-) ≤ β ≤ min(c₁, γ+),   γ± = c₂ - r ± √(c₂² + r²).
//
// It is computed in forces along the motion, w = F_d(k) sgn Δx_k and f = F_d(k-1) sgn Δx_k, where
// the second bound is a - h ≤ w ≤ a + h with a = c₂|Δx_k|, h = √(a² + f²), and a - h = -f²/(a + h):
// nothing is divided by a displacement, nothing cancels, nothing overflows.
//
// Source: Kim & Ryu, "Robustly stable haptic interaction control using an energy-bounding
// algorithm", IJRR 29(6), 2010; formula reconstructed. Displays about b/T. Realtime-safe: yes.
class EnergyBounding2010 {
 public:
  // More than 0: without a store no force may ever rise.
  static constexpr double kLeastStorageStiffness = 1e-3;
  static constexpr std::array<ParameterDescription, 2> kParameters{
      kBelievedDampingParameter,
      ParameterDescription{"storage_stiffness_n_per_m",
                           ParameterKind::kNumber,
                           "N/m",
                           kLeastStorageStiffness,
                           1e9,
                           {},
                           "b/T, the most that it may be",
                           "c₂: the control law's store holds F²/(2c₂)"}};
  static constexpr AlgorithmDescription kDescription{
      "energy-bounding-2010", "Energy bounding (2010)",
      "bounds what the hold gives out and what the control law gives out", kParameters,
      "F_d(k) = F_d(k-1) + β Δx,  β = (F_e - F_d(k-1))/Δx within [max(-c₁, γ-), min(c₁, γ+)],\n"
      "c₁ = b/T,  γ± = c₂ - r ± √(c₂² + r²),  r = F_d(k-1)/Δx;  held where Δx = 0"};

  // c₁ and c₂, named or by default.
  [[nodiscard]] static double hold_stiffness(const StabiliserContext& context) {
    return believed_damping(context) / context.period_s;
  }
  [[nodiscard]] static double storage_stiffness(const StabiliserContext& context) {
    const double most = hold_stiffness(context);
    return std::min(context.value_or("storage_stiffness_n_per_m", most), most);
  }

  void configure(const StabiliserContext& context) {
    hold_n_per_m_ = hold_stiffness(context);
    storage_n_per_m_ = storage_stiffness(context);
  }
  void reset() {}

  [[nodiscard]] double step(const StabiliserInput& input) const {
    const double moved_m = std::abs(input.displacement_m);
    if (!(moved_m > 0.0)) return input.previous_force_n;
    const double sign = std::copysign(1.0, input.displacement_m);
    const double before_n = sign * input.previous_force_n;  // f
    const double step_n = hold_n_per_m_ * moved_m;
    const double a_n = storage_n_per_m_ * moved_m;
    const double sum_n = a_n + hypotenuse(a_n, std::abs(before_n));
    const double lent_n = sum_n > 0.0 ? before_n * (before_n / sum_n) : 0.0;
    const double least_n = std::max(before_n - step_n, -lent_n);
    const double most_n = std::min(before_n + step_n, sum_n);
    // Where the bounds do not bind, F_d is F_e itself. By rounding they may pass each other.
    return sign * std::min(std::max(sign * input.wall_force_n, least_n), most_n);
  }

 private:
  // √(a² + b²), both ≥ 0, without overflow, from operations that round the same everywhere (the
  // lanes of a batch do the same; a library's hypot() need not).
  [[nodiscard]] static double hypotenuse(double a, double b) {
    const double large = std::max(a, b);
    if (!(large > 0.0)) return 0.0;
    const double ratio = std::min(a, b) / large;
    return large * std::sqrt(1.0 + ratio * ratio);
  }

  double hold_n_per_m_ = 0.0;
  double storage_n_per_m_ = 0.0;
};

}  // namespace hapticwall
