// The motion of a handle over a whole step, for any body whose forces are linear.
//
// The body has core states c with c' = A c, of which the acceleration of the handle and the change
// of the hand's force are rows: v' = α c, F_h' = φ c. Then, from the start (v, F_h, c) of a step,
//
//   ∫v     = h v + δ c                    δ c = ∫(v - v(0))
//   ∫v²    = v (h v + 2 δ c) + cᵀ S c     cᵀ S c = ∫(v - v(0))²
//   ∫F_h v = F_h ∫v + v (ε c) + cᵀ W c    ε c = ∫(F_h - F_h(0)), W of the product of both changes
//
// v and F_h are separate from c although c determines them. Computing them from c would cancel for
// a hand that follows its path loosely or stiffly.
#pragma once

#include <array>
#include <cstddef>

#include "core/plant/energy_totals.h"

namespace hapticwall {

// Upper triangle row by row: 11, 12, …, 22, …; off-diagonals doubled.
template <typename Real, std::size_t kStates>
using SymmetricForm = std::array<Real, kStates*(kStates + 1) / 2>;

// The order of the sum is fixed, because recordings must have the same bits everywhere.
template <typename Real, std::size_t kStates>
[[nodiscard]] [[gnu::always_inline]] inline Real dot(const std::array<Real, kStates>& row,
                                                     const std::array<Real, kStates>& c) {
  Real sum = row[0] * c[0];
  for (std::size_t i = 1; i < kStates; ++i) sum += row[i] * c[i];
  return sum;
}

template <typename Real, std::size_t kStates>
[[nodiscard]] [[gnu::always_inline]] inline Real quadratic(const SymmetricForm<Real, kStates>& form,
                                                           const std::array<Real, kStates>& c) {
  Real sum = 0;
  std::size_t k = 0;
  for (std::size_t i = 0; i < kStates; ++i) {
    Real part = form[k++] * c[i];
    for (std::size_t j = i + 1; j < kStates; ++j) part += form[k++] * c[j];
    sum = i == 0 ? c[i] * part : sum + c[i] * part;
  }
  return sum;
}

// A step by the scene's matrix. The members for a grip or a lag are unused without it.
template <typename Real, std::size_t kStates>
struct LinearRows {
  using Row = std::array<Real, kStates>;
  using Form = SymmetricForm<Real, kStates>;
  Real duration_s = 0;
  Row velocity{};          // v(h) - v(0)
  Row drift{};             // δ
  Row hand_force_drift{};  // ε
  Form square{};           // S
  Form hand_work{};        // W
  // Without a grip, for a path at rest (then v is the first state), which is the most frequent case
  // and cheaper.
  Row integral_at_rest{};  // ∫v
  Form square_at_rest{};   // ∫v²
  // Grip.
  Row difference{};                        // d(h) - d(0)
  Row stretch{};                           // ∫d
  std::array<Real, 2> stick_difference{};  // both while the handle sticks, from d relative to its
  std::array<Real, 2> stick_stretch{};     // settled value and d'
  // Lag.
  Real settled_fraction = 0;   // 1 - exp(-h/τ)
  Real excess_integral_s = 0;  // ∫e per newton of e
  Row excess_work{};           // ∫e (v - v(0)) per newton of e

  // Displacement and energies of the step.
  [[nodiscard]] [[gnu::always_inline]] MotionIncrement<Real> increment(Real velocity_m_per_s,
                                                                       Real hand_force_n,
                                                                       const Row& c) const {
    const Real drift_m = dot(drift, c);
    const Real steady_m = velocity_m_per_s * duration_s;
    MotionIncrement<Real> result;
    result.displacement_m = steady_m + drift_m;
    result.velocity_squared =
        velocity_m_per_s * (steady_m + 2 * drift_m) + quadratic<Real, kStates>(square, c);
    result.hand_work_j =
        hand_force_n * result.displacement_m +
        (velocity_m_per_s * dot(hand_force_drift, c) + quadratic<Real, kStates>(hand_work, c));
    return result;
  }
};

}  // namespace hapticwall
