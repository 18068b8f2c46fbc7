// Levant's differentiator: a sliding mode that is exact for accelerations below its gain.
#pragma once

#include <array>
#include <cmath>

#include "core/estimator/estimator.h"

namespace hapticwall {

// dz/dt = w - λ1 |z - x|^½ sign(z - x), dw/dt = -λ0 sign(z - x), v = w: with C above the largest
// acceleration, z and w reach x and its velocity in finite time. Euler's method takes 20 steps a
// tick, in which x stays x_k.
//
// Source: A. Levant, "Robust exact differentiation via sliding mode technique", Automatica 34(3),
// 1998; λ1 = 1.5 √C and λ0 = 1.1 C are its values.
struct Levant {
  static constexpr std::array kParameters{number_parameter(
      "gain", "m/s²", 1e-3, 1e6, "10", "C: the acceleration up to which the estimate follows")};
  static constexpr EstimatorDescription kDescription{
      "levant", "Levant's differentiator",
      "follows the positions by a sliding mode, up to an acceleration", kParameters,
      "z' = v - λ1 |z - x|^½ sign(z - x),  v' = -λ0 sign(z - x)\n"
      "λ1 = 1.5 √C, λ0 = 1.1 C, 20 Euler steps a tick"};

  void configure(const EstimatorContext& context) {
    step_s_ = 1.0 / (kSteps * context.rate_hz);
    root_gain_ = root_gain(context);
    sign_gain_m_per_s2_ = sign_gain_m_per_s2(context);
  }
  void reset() { error_m_ = velocity_m_per_s_ = 0.0; }
  double velocity(double /*position_m*/, double displacement_m) {
    error_m_ -= displacement_m;
    for (int i = 0; i < kSteps; ++i) {
      const double root = std::copysign(std::sqrt(std::abs(error_m_)), error_m_);
      const double sign = error_m_ == 0.0 ? 0.0 : std::copysign(1.0, error_m_);
      error_m_ += step_s_ * (velocity_m_per_s_ - root_gain_ * root);
      velocity_m_per_s_ -= step_s_ * sign_gain_m_per_s2_ * sign;
    }
    return velocity_m_per_s_;
  }

  static DerivedNumbers numbers(const EstimatorContext& context) {
    return {{{"λ1", root_gain(context), "√m/s"}, {"λ0", sign_gain_m_per_s2(context), "m/s²"}}};
  }

 private:
  static constexpr int kSteps = 20;

  static double gain_of(const EstimatorContext& context) { return context.value_or("gain", 10.0); }
  static double root_gain(const EstimatorContext& context) {
    return 1.5 * std::sqrt(gain_of(context));
  }
  static double sign_gain_m_per_s2(const EstimatorContext& context) {
    return 1.1 * gain_of(context);
  }

  double step_s_ = 0.0;
  double root_gain_ = 0.0;           // λ1, √m/s
  double sign_gain_m_per_s2_ = 0.0;  // λ0
  double error_m_ = 0.0;             // z - x
  double velocity_m_per_s_ = 0.0;
};

}  // namespace hapticwall
