// A piece of a motion as a polynomial in θ = t/h on [0, 1], and its first change of sign.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace hapticwall {

// With a step h so short that the fastest rate r of the motion has r h ≤ kTaylorReach, the terms
// that are left out are below 1e-19 of the largest.
inline constexpr int kTaylorDegree = 14;
inline constexpr double kTaylorReach = 0.25;

// Steps of T, T/2, T/4, … cover a piece of a tick, except for a rest that is short enough for a
// Taylor polynomial. This is the maximum number of halvings: 100 ms become 1e-17 s.
inline constexpr int kMaxHalvings = 53;
// Number of halvings after which the fastest rate (1/s) is within kTaylorReach. Realtime-safe: yes.
[[nodiscard]] int halvings_within_reach(double rate_per_s, double period_s);

template <typename Real>
struct TaylorPolynomial {
  std::array<Real, kTaylorDegree + 1> coefficient{};  // of θ^0 … θ^degree

  [[nodiscard]] Real at(Real theta) const {
    Real value = 0;
    for (auto c = coefficient.rbegin(); c != coefficient.rend(); ++c) value = value * theta + *c;
    return value;
  }
  // dP/dθ.
  [[nodiscard]] Real slope_at(Real theta) const;
  // ∫_0^θ P.
  [[nodiscard]] Real integral_to(Real theta) const;
};

// ∫_0^θ P Q for each P. Realtime-safe: yes, this and what follows.
template <typename Real, std::size_t kCount>
[[nodiscard]] std::array<Real, kCount> product_integrals(
    const std::array<const TaylorPolynomial<Real>*, kCount>& ps, const TaylorPolynomial<Real>& q,
    Real theta);

// The first θ in [0, 1] at which `sign` * P turns from positive to negative, or nothing. `sign` is
// +1 or -1. A start at zero, or below it by rounding, counts as zero, and gives 0 only if sign * P
// then becomes negative. No root is missed (Bernstein coefficients and subdivision, then Newton
// within brackets).
template <typename Real>
[[nodiscard]] std::optional<Real> first_crossing(const TaylorPolynomial<Real>& p, Real sign);

}  // namespace hapticwall
