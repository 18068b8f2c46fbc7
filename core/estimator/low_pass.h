// The backward difference behind a first-order low-pass filter.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "core/estimator/estimator.h"

namespace hapticwall {

// v_k = p v_{k-1} + (1 - p)(x_k - x_{k-1})/T. The pole p = e^(-2π f_c T) is that of the filter of
// continuous time. The estimate of a slow motion comes p/(1 - p) ticks later than the backward
// difference, about 1/(2π f_c).
//
// Source: J. E. Colgate and J. M. Brown, "Factors affecting the Z-width of a haptic display", IEEE
// ICRA, 1994.
struct LowPass {
  static constexpr std::array kParameters{number_parameter(
      "cutoff_hz", "Hz", 0.1, 1e5, "30", "f_c: frequency at which the filter passes 0.71")};
  static constexpr EstimatorDescription kDescription{
      "low-pass", "Low-pass filter", "filters the backward difference by a low-pass of order one",
      kParameters, "v_k = p v_{k-1} + (1 - p)(x_k - x_{k-1})/T,  p = e^(-2π f_c T)"};

  void configure(const EstimatorContext& context) {
    share_ = share_of(context);
    rate_hz_ = context.rate_hz;
  }
  void reset() { velocity_m_per_s_ = 0.0; }
  double velocity(double /*position_m*/, double displacement_m) {
    velocity_m_per_s_ += share_ * (displacement_m * rate_hz_ - velocity_m_per_s_);
    return velocity_m_per_s_;
  }

  static VelocityTransfer transfer(const EstimatorContext& context) {
    const double share = share_of(context);
    return {.numerator = {share}, .denominator = {1.0, share - 1.0}, .denominator_count = 2};
  }

 private:
  // 1 - p
  static double share_of(const EstimatorContext& context) {
    const double cutoff_hz = context.value_or("cutoff_hz", 30.0);
    return -std::expm1(-2.0 * std::numbers::pi * cutoff_hz / context.rate_hz);
  }

  double share_ = 1.0;
  double rate_hz_ = 0.0;
  double velocity_m_per_s_ = 0.0;
};

}  // namespace hapticwall
