// A piece of a motion as a polynomial in θ = t/h on [0, 1], and where it first changes its sign.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace hapticwall {

// With a step h so short that the fastest rate r of the motion has r h ≤ kTaylorReach, the terms
// that are left out are below 1e-19 of the largest.
inline constexpr int kTaylorDegree = 14;
inline constexpr double kTaylorReach = 0.25;

struct TaylorPolynomial {
  std::array<double, kTaylorDegree + 1> coefficient{};  // of θ^0 … θ^degree

  [[nodiscard]] double at(double theta) const {
    double value = 0.0;
    for (auto c = coefficient.rbegin(); c != coefficient.rend(); ++c) value = value * theta + *c;
    return value;
  }
  // dP/dθ.
  [[nodiscard]] double slope_at(double theta) const;
  // ∫_0^θ P.
  [[nodiscard]] double integral_to(double theta) const;
  // ∫_0^θ ∫_0^φ P.
  [[nodiscard]] double double_integral_to(double theta) const;
};

// ∫_0^θ P Q. Realtime-safe: yes.
[[nodiscard]] double product_integral(const TaylorPolynomial& p, const TaylorPolynomial& q,
                                      double theta);

// ∫_0^θ P(φ) (∫_0^φ Q) dφ. Realtime-safe: yes.
[[nodiscard]] double lagged_product_integral(const TaylorPolynomial& p, const TaylorPolynomial& q,
                                             double theta);

// The first θ in [0, 1] at which `sign` * P turns from positive to negative, or nothing. `sign` is
// +1 or -1. A start at zero, or on the wrong side by rounding, counts as zero: 0 is returned only
// if P then leaves on the wrong side. No root is missed (Bernstein coefficients and subdivision;
// then Newton, kept between its brackets). Realtime-safe: yes.
[[nodiscard]] std::optional<double> first_crossing(const TaylorPolynomial& p, double sign);

}  // namespace hapticwall
