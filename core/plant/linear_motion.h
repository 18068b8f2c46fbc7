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
// v and F_h are told apart from c although they could be had from it: a hand that hardly follows
// its path, or follows it stiffly, would otherwise make large numbers out of small ones.
#pragma once

#include <array>
#include <cstddef>

#include "core/plant/amplifier_lag.h"
#include "core/plant/energy_totals.h"
#include "core/plant/propagator.h"
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

  // What the step moves and exchanges.
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

// The equations in scaled states: time in ticks, `unit` what a unit of each state is in SI.
template <std::size_t kStates>
struct LinearGenerator {
  static constexpr int kCore = static_cast<int>(kStates);
  static constexpr int kVelocity = kCore;       // v - v(0), m/s
  static constexpr int kHandForce = kCore + 1;  // (F_h - F_h(0)) T/m
  static constexpr int kSize = kCore + 2;
  using Matrix = SetupMatrix<kSize>;

  Matrix matrix = Matrix::Zero();
  std::array<long double, kStates> unit{};
  long double period_s = 1.0L;
  long double mass_kg = 1.0L;  // m
  double time_constant_s = 0.0;

  template <bool kLag>
  [[nodiscard]] static auto weights() {
    Matrix square = Matrix::Zero();
    square(kVelocity, kVelocity) = 1.0L;
    Matrix product = Matrix::Zero();
    product(kVelocity, kHandForce) = product(kHandForce, kVelocity) = 0.5L;
    if constexpr (kLag) {
      Matrix excess = Matrix::Zero();
      excess(kCore - 1, kVelocity) = excess(kVelocity, kCore - 1) = 0.5L;
      return std::array{square, product, excess};
    } else {
      return std::array{square, product};
    }
  }

  template <typename Real>
  [[nodiscard]] std::array<Real, kStates> row(const Matrix& matrix_of_step, int output,
                                              long double scale) const {
    std::array<Real, kStates> numbers{};
    for (std::size_t i = 0; i < kStates; ++i) {
      numbers[i] = static_cast<Real>(matrix_of_step(output, static_cast<int>(i)) * unit[i] * scale);
    }
    return numbers;
  }

  template <typename Real>
  [[nodiscard]] SymmetricForm<Real, kStates> form(const Matrix& integral, long double scale) const {
    SymmetricForm<Real, kStates> numbers{};
    std::size_t k = 0;
    for (std::size_t i = 0; i < kStates; ++i) {
      for (std::size_t j = i; j < kStates; ++j) {
        const long double twice = i == j ? 1.0L : 2.0L;
        numbers[k++] = static_cast<Real>(
            twice * integral(static_cast<int>(i), static_cast<int>(j)) * unit[i] * unit[j] * scale);
      }
    }
    return numbers;
  }

  template <typename Real, bool kLag, std::size_t kWeights>
  void fill(LinearRows<Real, kLag, kStates>& rows, const Propagator<kSize, kWeights>& step,
            long double duration_s) const {
    rows.duration_s = static_cast<Real>(duration_s);
    rows.velocity = row<Real>(step.increment, kVelocity, 1.0L);
    rows.drift = row<Real>(step.integral, kVelocity, period_s);
    rows.hand_force_drift = row<Real>(step.integral, kHandForce, mass_kg);
    rows.square = form<Real>(step.integrals[0], period_s);
    rows.hand_work = form<Real>(step.integrals[1], mass_kg);
    if constexpr (kLag) {
      rows.lag = {duration_s, static_cast<long double>(time_constant_s)};
      for (std::size_t i = 0; i < kStates; ++i) {
        const long double twice = i + 1 == kStates ? 1.0L : 2.0L;
        rows.lag.cross[i] = static_cast<Real>(
            twice * step.integrals[2](kCore - 1, static_cast<int>(i)) * unit[i] * period_s);
      }
    }
  }
};

// The same of a piece of `duration_s` as polynomials of θ, up to θ.
template <typename Real>
[[nodiscard]] MotionIncrement<Real> integrate(const TaylorPolynomial<Real>& velocity,
                                              const TaylorPolynomial<Real>& hand_force,
                                              Real duration_s, Real theta) {
  MotionIncrement<Real> increment;
  increment.displacement_m = duration_s * velocity.integral_to(theta);
  increment.velocity_squared = duration_s * product_integral(velocity, velocity, theta);
  increment.hand_work_j = duration_s * product_integral(hand_force, velocity, theta);
  return increment;
}

}  // namespace hapticwall
