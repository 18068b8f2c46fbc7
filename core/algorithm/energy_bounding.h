// The energy bounding algorithm of the paper.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/algorithm/algorithm.h"

namespace hapticwall {

// F_d(k) = F_d(k-1) + clamp(F_e - F_d(k-1), ±b|v_k|)   where |Δx_k| > kMaxRestM,
//          F_d(k-1) + clamp(F_e - F_d(k-1), ±α_max)    where the encoder shows no motion.
//
// `form = "vector"` bounds the force of both axes as one vector, with the smaller b of both:
//
//   F_d(k) = F_d(k-1) + ΔF min(1, b‖v_k‖/‖ΔF‖),  ΔF = F_e - F_d(k-1).
//
// Its change is then along ΔF, whereas a bound for each axis turns the force off its direction. The
// invariant is that of the sum of both axes, because |ΔF·Δx| ≤ ‖ΔF‖‖Δx‖. On one axis both forms are
// the same.
//
// Source: paper, Eq. 20-22, without the published division by v_k, which overflows for a tiny
// velocity. Invariant: energy_hold ≥ energy_budget at every row, because each row in motion adds
// (F_d(k-1) - F_d(k)) Δx_k ≥ -b|v_k||Δx_k| = -T b v_k², and a row at rest at most 1e-15 J per
// newton. It bounds the hold only: the lag of F_d behind F_e can make the control law itself active
// (docs/physics.md).
struct EnergyBounding {
  // The last digits of a position within ±1 m, where a session ends: 4.5 units of 2.2e-16 m. A
  // thousandth of the smallest encoder count that a scene may have.
  static constexpr double kMaxRestM = 1e-15;
  static constexpr std::array<std::string_view, 2> kForms{"per-axis", "vector"};
  static constexpr std::array<ParameterDescription, 3> kParameters{
      kBelievedDampingParameter,
      number_parameter(
          "rest_force_step_n", "N", 0.0, 1e6,
          "b times 0.0075 m/s with an encoder, no limit without",
          "α_max: the largest change of force in a tick without measured motion; press "
          "is quiet from 0.0053 to 0.024 N"),
      choice_parameter("form", kForms,
                       "whether each axis has a bound, or the force of both as a vector has one")};
  static bool is_vector(const AlgorithmContext& context) {
    return context.value_or("form", 0.0) != 0.0;
  }

  static constexpr std::array<SignalDescription, 1> kSignals{
      {{"step_bound_n",
        "b|v|, or α_max without motion: the largest change of force in this tick"}}};
  static constexpr AlgorithmDescription kDescription{
      "energy-bounding",
      "Energy bounding",
      "limits the change of force in a tick to what the device's damping can dissipate",
      kParameters,
      "F_d(k) = F_d(k-1) + (F_e - F_d(k-1)) within ±b|v|, within ±α_max at rest",
      kSignals,
      nullptr,
      "",
      "",
      is_vector};

  // A count hides a motion of Δ per rest, not per tick: b Δ/T in each of n quiet ticks exceeds the
  // budget n times. The default allows the force of a slow hidden motion. 0.0075 m/s is a choice of
  // ours, by a sweep (docs/algorithms/energy-bounding.md). Without an encoder rest is rest, and the
  // paper needs no bound.
  void configure(const AlgorithmContext& context) {
    constexpr double kHiddenMPerS = 0.0075;
    damping_n_s_per_m_ = believed_damping(context);
    const double hidden_n = context.encoder_m > 0.0 ? damping_n_s_per_m_ * kHiddenMPerS
                                                    : std::numeric_limits<double>::max();
    rest_force_step_n_ = context.value_or("rest_force_step_n", hidden_n);
    is_vector_ = is_vector(context);
  }
  void reset() {}

  double step(const AlgorithmInput& in, std::span<double> signals) {
    if (is_vector_ && in.other != nullptr) return step_as_vector(in, *in.other, signals);
    const double bound_n = std::abs(in.displacement_m) > kMaxRestM
                               ? damping_n_s_per_m_ * std::abs(in.velocity_m_per_s)
                               : rest_force_step_n_;
    if (bound_n < std::numeric_limits<double>::max()) signals[0] = bound_n;
    const double wanted_step_n = in.wall_force_n - in.previous_force_n;
    // Within the bound F_d is F_e itself, not F_e up to rounding.
    if (std::abs(wanted_step_n) <= bound_n) return in.wall_force_n;
    return in.previous_force_n + std::copysign(bound_n, wanted_step_n);
  }

 private:
  [[nodiscard]] double step_as_vector(const AlgorithmInput& in, const OtherAxis& other,
                                      std::span<double> signals) const {
    const bool moves =
        std::abs(in.displacement_m) > kMaxRestM || std::abs(other.displacement_m) > kMaxRestM;
    const double damping_n_s_per_m = std::min(damping_n_s_per_m_, other.damping_n_s_per_m);
    const double bound_n =
        moves ? damping_n_s_per_m * length(in.velocity_m_per_s, other.velocity_m_per_s)
              : rest_force_step_n_;
    if (bound_n < std::numeric_limits<double>::max()) signals[0] = bound_n;
    const double step_n = in.wall_force_n - in.previous_force_n;
    const double wanted_n = length(step_n, other.wall_force_n - other.previous_force_n);
    if (wanted_n <= bound_n) return in.wall_force_n;
    return in.previous_force_n + step_n * (bound_n / wanted_n);
  }
  static double length(double a, double b) { return std::sqrt(a * a + b * b); }

  bool is_vector_ = false;
  double damping_n_s_per_m_ = 0.0;  // b
  double rest_force_step_n_ = 0.0;  // α_max
};

}  // namespace hapticwall
