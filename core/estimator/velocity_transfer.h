// The transfer function of a linear velocity estimator.
#pragma once

#include <array>
#include <cstddef>

namespace hapticwall {

// Points of the longest window of positions.
inline constexpr std::size_t kMaxEstimatorPoints = 50;

// V(z) T/X(z) = (1 - 1/z) (n_0 + n_1/z + ...)/(d_0 + d_1/z + ...) with d_0 = 1. The default is the
// backward difference.
struct VelocityTransfer {
  std::array<double, kMaxEstimatorPoints - 1> numerator{1.0};
  std::size_t numerator_count = 1;
  std::array<double, 3> denominator{1.0};
  std::size_t denominator_count = 1;

  [[nodiscard]] bool is_difference() const { return numerator_count + denominator_count == 2; }
  // Delay of a slow motion, in ticks: half a tick for the backward difference.
  [[nodiscard]] double delay_ticks() const {
    return 0.5 + mean_power(numerator, numerator_count) -
           mean_power(denominator, denominator_count);
  }

 private:
  template <std::size_t kSize>
  static double mean_power(const std::array<double, kSize>& coefficients, std::size_t count) {
    double sum = 0.0;
    double moment = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      sum += coefficients.at(i);
      moment += static_cast<double>(i) * coefficients.at(i);
    }
    return moment / sum;
  }
};

}  // namespace hapticwall
