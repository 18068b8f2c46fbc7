// An amplifier that follows its command F as a first-order lag: F_a' = (F - F_a)/τ. Over a step
// with constant F the excess e = F_a - F falls as exp(-t/τ). Without a lag (kLag false) these
// structs are empty and cost nothing.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/plant/taylor_polynomial.h"

namespace hapticwall {

// The part of a body's state that a lag adds.
template <typename Real, bool kLag>
struct ActuatorState {};

template <typename Real>
struct ActuatorState<Real, true> {
  Real actuator_n = 0;  // F_a

  [[nodiscard]] Real excess_n(Real force_n) const { return actuator_n - force_n; }
};

template <typename Real, bool kLag>
struct AmplifierLag {
  explicit AmplifierLag(double /*time_constant_s*/) {}
};

template <typename Real>
struct AmplifierLag<Real, true> {
  Real rate_per_s;  // 1/τ

  explicit AmplifierLag(double time_constant_s)
      : rate_per_s(1 / static_cast<Real>(time_constant_s)) {}
};

// A step by the scene's matrix. kStates: of the body, the excess last.
template <typename Real, bool kLag, std::size_t kStates>
struct LagRows {
  void settle(ActuatorState<Real, false>& /*state*/, Real /*force_n*/) const {}
};

template <typename Real, std::size_t kStates>
struct LagRows<Real, true, kStates> {
  Real settled_fraction = 0;          // 1 - exp(-h/τ)
  Real integral_s = 0;                // ∫e dt per newton of excess: τ (1 - exp(-h/τ))
  std::array<Real, kStates> cross{};  // ∫ e (v - v(0)) dt per newton of excess, of the states

  LagRows() = default;
  LagRows(long double duration_s, long double time_constant_s)
      : settled_fraction(static_cast<Real>(-std::expm1(-duration_s / time_constant_s))),
        integral_s(
            static_cast<Real>(-time_constant_s * std::expm1(-duration_s / time_constant_s))) {}

  // ∫ e v dt.
  [[nodiscard]] Real work(Real velocity_m_per_s, const std::array<Real, kStates>& states) const {
    Real sum = velocity_m_per_s * integral_s;
    for (std::size_t i = 0; i < kStates; ++i) sum += cross[i] * states[i];
    return states.back() * sum;
  }
  // F_a at the end of the step.
  void settle(ActuatorState<Real, true>& state, Real force_n) const {
    state.actuator_n -= settled_fraction * state.excess_n(force_n);
  }
};

// A piece of a step as a polynomial.
template <typename Real, bool kLag>
struct LagPiece {
  void settle(ActuatorState<Real, false>& /*state*/, Real /*theta*/) const {}
};

template <typename Real>
struct LagPiece<Real, true> {
  TaylorPolynomial<Real> excess;  // e(θ), newtons
  Real force_n = 0;               // F

  LagPiece() = default;
  LagPiece(Real excess_n, Real force, Real duration_s, Real rate_per_s) : force_n(force) {
    auto& e = excess.coefficient;
    e[0] = excess_n;
    for (std::size_t j = 1; j < e.size(); ++j) {
      e[j] = -e[j - 1] * (duration_s * rate_per_s) / static_cast<Real>(j);
    }
  }

  void settle(ActuatorState<Real, true>& state, Real theta) const {
    state.actuator_n = force_n + excess.at(theta);
  }
};

}  // namespace hapticwall
