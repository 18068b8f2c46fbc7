// The second energy bounding algorithm: it makes the control law passive, too.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/algorithm/algorithm.h"
#include "core/scene_keys.h"

namespace hapticwall {

// While the encoder shows motion, the force follows F_e within two bounds:
//
//   |F_d(k) - F_d(k-1)| ≤ c₁|Δx_k|                              c₁ = b/T: the hold, as in Eq. 20-22
//   F_d(k) Δx_k ≥ (F_d(k)² - F_d(k-1)²)/(2c₂)                   0 < c₂ ≤ c₁: the control law
//
// Without motion the force is held. By the second bound the algorithm pays what it gives out from a
// store of F²/(2c₂). In β = (F_d(k) - F_d(k-1))/Δx_k, with r = F_d(k-1)/Δx_k, both are
//
//   max(-c₁, γ-) ≤ β ≤ min(c₁, γ+),   γ± = c₂ - r ± √(c₂² + r²).
//
// The algorithm computes forces along the motion, w = F_d(k) sgn Δx_k and f = F_d(k-1) sgn Δx_k.
// The second bound is then a - h ≤ w ≤ a + h with a = c₂|Δx_k|, h = √(a² + f²), and a - h = -f²/(a
// + h). This form does not divide by a displacement, cancel or overflow.
//
// Source: Kim & Ryu, "Robustly stable haptic interaction control using an energy-bounding
// algorithm", IJRR 29(6), 2010; formula reconstructed. Displays about b/T.
struct EnergyBounding2010 {
  // Without a store no force may ever rise.
  static constexpr double kMinStorageStiffness = 1e-3;
  static constexpr std::array<ParameterDescription, 2> kParameters{
      kBelievedDampingParameter,
      number_parameter("storage_stiffness_n_per_m", "N/m", kMinStorageStiffness, 1e9,
                       "b/T, the most that it may be",
                       "c₂: the control law's store holds F²/(2c₂)")};

  // c₁.
  static double hold_stiffness(const AlgorithmContext& context) {
    return believed_damping(context) / context.period_s;
  }
  static double storage_stiffness(const AlgorithmContext& context) {
    return context.value_or("storage_stiffness_n_per_m", hold_stiffness(context));
  }
  static std::optional<SceneProblem> problem(const AlgorithmContext& context) {
    const double storage = storage_stiffness(context);
    const double max_storage = hold_stiffness(context);
    if (storage <= max_storage) return std::nullopt;
    return SceneProblem{"algorithm.storage_stiffness_n_per_m",
                        number_text(storage) +
                            " is more than the hold can carry: it takes at most b/T = " +
                            number_text(max_storage) + " N/m"};
  }

  static constexpr std::array<SignalDescription, 2> kSignals{
      {{"step_bound_n", "c₁|Δx|: the largest change of force in this tick"},
       {"store_j", "F_d²/(2c₂): the energy in the control law's store"}}};
  static constexpr AlgorithmDescription kDescription{
      "energy-bounding-2010",
      "Energy bounding (2010)",
      "bounds what the hold gives out and what the control law gives out",
      kParameters,
      "F_d(k) = F_d(k-1) + β Δx,  β = (F_e - F_d(k-1))/Δx within [max(-c₁, γ-), min(c₁, γ+)],\n"
      "c₁ = b/T,  γ± = c₂ - r ± √(c₂² + r²),  r = F_d(k-1)/Δx;  held where Δx = 0",
      kSignals,
      problem};

  void configure(const AlgorithmContext& context) {
    hold_n_per_m_ = hold_stiffness(context);
    storage_n_per_m_ = std::min(storage_stiffness(context), hold_n_per_m_);
  }
  void reset() {}

  double step(const AlgorithmInput& in, std::span<double> signals) {
    const double moved_m = std::abs(in.displacement_m);
    const double force_n = moved_m > 0.0 ? bounded(in, moved_m) : in.previous_force_n;
    signals[0] = hold_n_per_m_ * moved_m;
    signals[1] = force_n * force_n / (2.0 * storage_n_per_m_);
    return force_n;
  }

 private:
  [[nodiscard]] double bounded(const AlgorithmInput& in, double moved_m) const {
    const double sign = std::copysign(1.0, in.displacement_m);
    const double before_n = sign * in.previous_force_n;  // f
    const double step_n = hold_n_per_m_ * moved_m;
    const double a_n = storage_n_per_m_ * moved_m;
    const double sum_n = a_n + hypotenuse(a_n, std::abs(before_n));
    const double lent_n = sum_n > 0.0 ? before_n * (before_n / sum_n) : 0.0;
    const double min_n = std::max(before_n - step_n, -lent_n);
    const double max_n = std::min(before_n + step_n, sum_n);
    // Within the bounds F_d is F_e itself. Not std::clamp(): rounding may let the bounds pass each
    // other.
    return sign * std::min(std::max(sign * in.wall_force_n, min_n), max_n);
  }

  // √(a² + b²), both ≥ 0, without overflow. Not hypot(), whose rounding depends on the library.
  [[nodiscard]] static double hypotenuse(double a, double b) {
    const double large = std::max(a, b);
    if (!(large > 0.0)) return 0.0;
    const double ratio = std::min(a, b) / large;
    return large * std::sqrt(1.0 + ratio * ratio);
  }

  double hold_n_per_m_ = 0.0;     // c₁
  double storage_n_per_m_ = 0.0;  // c₂
};

}  // namespace hapticwall
