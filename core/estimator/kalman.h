// The Kalman filter of position and velocity in its steady state.
#pragma once

#include <array>
#include <cmath>

#include "core/estimator/estimator.h"

namespace hapticwall {

// The model: the acceleration is white noise of the spectral density q, m²/s³, and each position
// has an independent error of the variance r, m². A tick predicts, then corrects by the surprise
// e = x_k - (x + v T): x += x + v T + α e, v += β e/T. The steady state depends on
// λ = q T³/r alone. Its Riccati equation has the solution, with y = (√λ + √(λ/3 + 16))/2 and
// d = √(√λ y - λ/6), s = 2/(y + d): α = s d, β = √λ s.
//
// Source: Y. Bar-Shalom, X. R. Li and T. Kirubarajan, "Estimation with Applications to Tracking and
// Navigation", Wiley, 2001, on the model with continuous white noise; P. R. Bélanger, P.
// Dobrovolny, A. Helmy and X. Zhang, "Estimation of angular velocity and acceleration from
// shaft-encoder measurements", Int. J. Robotics Research 17(11), 1998, on encoders.
struct Kalman {
  static constexpr std::array kParameters{
      number_parameter("noise_ratio", "", 1e-12, 1e6, "0.1",
                       "λ = q T³/r: the noise of the acceleration over that of the position")};
  static constexpr EstimatorDescription kDescription{
      "kalman", "Kalman filter",
      "predicts position and velocity, and corrects both by each position", kParameters,
      "e = x_k - (x + v T)\n"
      "x = x + v T + α e,  v = v + β e/T,  α and β by λ = q T³/r"};

  void configure(const EstimatorContext& context) {
    const Gains gains = gains_of(context);
    kept_ = gains.kept;
    velocity_gain_hz_ = gains.velocity * context.rate_hz;
    period_s_ = 1.0 / context.rate_hz;
  }
  void reset() { error_m_ = velocity_m_per_s_ = 0.0; }
  double velocity(double /*position_m*/, double displacement_m) {
    const double surprise_m = displacement_m - error_m_ - velocity_m_per_s_ * period_s_;
    error_m_ = -kept_ * surprise_m;
    velocity_m_per_s_ += velocity_gain_hz_ * surprise_m;
    return velocity_m_per_s_;
  }

  // V T/X = β(1 - 1/z)/(1 - (2 - α - β)/z + (1 - α)/z²)
  static VelocityTransfer transfer(const EstimatorContext& context) {
    const Gains gains = gains_of(context);
    return {.numerator = {gains.velocity},
            .denominator = {1.0, gains.velocity - 1.0 - gains.kept, gains.kept},
            .denominator_count = 3};
  }
  static DerivedNumbers numbers(const EstimatorContext& context) {
    const Gains gains = gains_of(context);
    return {{{"gain of the position", gains.position, ""},
             {"gain of the velocity", gains.velocity * context.rate_hz, "/s"}}};
  }

 private:
  struct Gains {
    double position = 0.0;  // α
    double velocity = 0.0;  // β
    double kept = 0.0;      // 1 - α
  };
  static Gains gains_of(const EstimatorContext& context) {
    const double ratio = context.value_or("noise_ratio", 0.1);
    const double root = std::sqrt(ratio);
    const double sum = 0.5 * (root + std::sqrt(ratio / 3.0 + 16.0));  // 1/s + s
    const double difference = std::sqrt(root * sum - ratio / 6.0);    // 1/s - s
    const double s = 2.0 / (sum + difference);
    return {s * difference, root * s, s * s};
  }

  double kept_ = 0.0;              // 1 - α
  double velocity_gain_hz_ = 0.0;  // β/T
  double period_s_ = 0.0;
  double error_m_ = 0.0;  // estimate of the position minus the measured one
  double velocity_m_per_s_ = 0.0;
};

}  // namespace hapticwall
