// The motion of a handle over a step, for any body whose forces are linear.
//
// The body has core states c with c' = A c, of which the acceleration of the handle and the change
// of the hand's force are rows: v' = α c, F_h' = φ c. Then, from the start (v, F_h, c) of a step,
//
//   ∫v    = h v + δ c                          δ c = ∫(v - v(0))
//   ∫v²   = v (h v + 2 δ c) + cᵀ S c           cᵀ S c = ∫(v - v(0))²
//   ∫F_h v = F_h ∫v + v (ε c) + cᵀ W c         ε c = ∫(F_h - F_h(0)), W of the product of both
//   changes
//
// v and F_h are separate from c although c determines them. Computing them from c would cancel for
// a hand that follows its path loosely or stiffly.
#pragma once

#include <array>
#include <cstddef>

#include "core/plant/amplifier_lag.h"
#include "core/plant/energy_totals.h"
#include "core/plant/taylor_polynomial.h"

namespace hapticwall {

// Upper triangle row by row: 11, 12, …, 22, …; off-diagonals doubled.
template <typename Real, std::size_t kStates>
using SymmetricForm = std::array<Real, kStates*(kStates + 1) / 2>;

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

// A step by the scene's matrix. With a lag its excess e is the last of the states.
template <typename Real, bool kLag, std::size_t kStates>
struct LinearRows {
  using Row = std::array<Real, kStates>;
  Real duration_s = 0;
  Row velocity{};                            // v(h) - v(0)
  Row drift{};                               // δ
  Row hand_force_drift{};                    // ε
  SymmetricForm<Real, kStates> square{};     // S
  SymmetricForm<Real, kStates> hand_work{};  // W
  LagRows<Real, kLag, kStates> lag;

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
    if constexpr (kLag) result.lag_work_j = lag.work(velocity_m_per_s, c);
    return result;
  }
};

// Increment over a piece of `duration_s` from polynomials of θ, up to θ.
template <typename Real, bool kLag>
[[nodiscard]] MotionIncrement<Real> integrate(const TaylorPolynomial<Real>& velocity,
                                              const TaylorPolynomial<Real>& hand_force,
                                              const LagPiece<Real, kLag>& lag, Real duration_s,
                                              Real theta) {
  std::array<const TaylorPolynomial<Real>*, kLag ? 3 : 2> factors{&velocity, &hand_force};
  if constexpr (kLag) factors[2] = &lag.excess;
  const auto products = product_integrals(factors, velocity, theta);
  MotionIncrement<Real> increment;
  increment.displacement_m = duration_s * velocity.integral_to(theta);
  increment.velocity_squared = duration_s * products[0];
  increment.hand_work_j = duration_s * products[1];
  if constexpr (kLag) increment.lag_work_j = duration_s * products[2];
  return increment;
}

}  // namespace hapticwall
