// First-order adaptive windowing: the difference over a window that is long at low speed.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/estimator/estimator.h"
#include "core/estimator/recent_displacements.h"

namespace hapticwall {

// v_k = (x_k - x_{k-m})/(m T): the window grows from m = 1 to at most n while the line through its
// two ends passes within one count of the encoder of every position between them. The delay is (m -
// 1)/2 ticks more than that of the backward difference: long at rest, where one count is the noise,
// and none in a fast motion. Without an encoder it is the backward difference.
//
// Source: F. Janabi-Sharifi, V. Hayward and C.-S. J. Chen, "Discrete-time adaptive windowing for
// velocity estimation", IEEE Trans. Control Systems Technology 8(6), 2000; the end-fit form.
struct Foaw {
  static constexpr std::array kParameters{kPointsParameter};
  static constexpr EstimatorDescription kDescription{
      "foaw", "First-order adaptive window",
      "divides the displacement over the longest window that one count of the encoder explains",
      kParameters,
      "v_k = (x_k - x_{k-m})/(m T)\n"
      "m <= n: the most with |x_k - x_{k-i} - i (x_k - x_{k-m})/m| <= Δ for 0 < i < m"};

  void configure(const EstimatorContext& context) {
    points_ = points_of(context);
    rate_hz_ = context.rate_hz;
    // Multiples of the count are not exact in binary; a line at one count is within it.
    constexpr double kRounding = 1e-6;
    encoder_m_ = context.encoder_m * (1.0 + kRounding);
  }
  void reset() { displacements_.reset(); }
  double velocity(double /*position_m*/, double displacement_m) {
    displacements_.push(displacement_m);
    if (encoder_m_ <= 0.0) return displacement_m * rate_hz_;
    std::array<double, kMaxEstimatorPoints + 1> back_m{};  // x_k - x_{k-i}
    double velocity_m_per_tick = displacement_m;
    for (std::size_t m = 1; m <= points_; ++m) {
      back_m.at(m) = back_m.at(m - 1) + displacements_.at(m - 1);
      const double slope_m = back_m.at(m) / static_cast<double>(m);
      for (std::size_t i = 1; i < m; ++i) {
        const double line_m = static_cast<double>(i) * slope_m;
        if (std::abs(back_m.at(i) - line_m) > encoder_m_) return velocity_m_per_tick * rate_hz_;
      }
      velocity_m_per_tick = slope_m;
    }
    return velocity_m_per_tick * rate_hz_;
  }

 private:
  std::size_t points_ = 2;
  double rate_hz_ = 0.0;
  double encoder_m_ = 0.0;  // 0: none
  RecentDisplacements displacements_;
};

}  // namespace hapticwall
