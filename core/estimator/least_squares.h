// The slope of the least-squares line through the newest positions.
#pragma once

#include <array>
#include <cstddef>

#include "core/estimator/estimator.h"
#include "core/estimator/recent_displacements.h"

namespace hapticwall {

// v_k = Σ ((n-1)/2 - i) x_{k-i}/(S T) over i = 0 … n-1, S = n(n² - 1)/12. As a sum of displacements
// d_{k-i} the weights are 6(i + 1)(n - 1 - i)/(n(n² - 1)). The estimate is (n - 2)/2 ticks later
// than the backward difference, which n = 2 is.
//
// Source: R. H. Brown, S. C. Schneider and M. G. Mulligan, "Analysis of algorithms for velocity
// estimation from discrete position versus time data", IEEE Trans. Industrial Electronics 39(1),
// 1992.
struct LeastSquares {
  static constexpr std::array kParameters{kPointsParameter};
  static constexpr EstimatorDescription kDescription{
      "least-squares", "Least squares", "takes the slope of a line fitted to the newest positions",
      kParameters, "v_k = 12 Σ ((n-1)/2 - i) x_{k-i}/(n(n² - 1) T),  i = 0 … n-1"};

  void configure(const EstimatorContext& context) {
    points_ = points_of(context);
    rate_hz_ = context.rate_hz;
  }
  void reset() { displacements_.reset(); }
  double velocity(double /*position_m*/, double displacement_m) {
    displacements_.push(displacement_m);
    double sum_m = 0.0;
    for (std::size_t i = 0; i + 1 < points_; ++i)
      sum_m += weight(points_, i) * displacements_.at(i);
    return sum_m * scale(points_) * rate_hz_;
  }

  static VelocityTransfer transfer(const EstimatorContext& context) {
    const std::size_t points = points_of(context);
    VelocityTransfer transfer;
    transfer.numerator_count = points - 1;
    for (std::size_t i = 0; i + 1 < points; ++i)
      transfer.numerator.at(i) = weight(points, i) * scale(points);
    return transfer;
  }

 private:
  static double weight(std::size_t points, std::size_t age) {
    return static_cast<double>((age + 1) * (points - 1 - age));
  }
  static double scale(std::size_t points) {
    const auto n = static_cast<double>(points);
    return 6.0 / (n * (n * n - 1.0));
  }

  std::size_t points_ = 2;
  double rate_hz_ = 0.0;
  RecentDisplacements displacements_;
};

}  // namespace hapticwall
