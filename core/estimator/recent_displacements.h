// The newest displacements of the handle, for estimators with a window of positions.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/estimator/estimator.h"
#include "core/estimator/velocity_transfer.h"

namespace hapticwall {

inline constexpr ParameterDescription kPointsParameter = number_parameter(
    "points", "", 2.0, static_cast<double>(kMaxEstimatorPoints), "8",
    "n, rounded: positions in the window; of foaw the most before the present one");

[[nodiscard]] inline std::size_t points_of(const EstimatorContext& context) {
  return static_cast<std::size_t>(std::round(context.value_or(kPointsParameter.key, 8.0)));
}

// A ring. Displacements before the first tick are 0: the handle counts as at rest.
class RecentDisplacements {
 public:
  void push(double displacement_m) {
    newest_ = (newest_ + 1) % kCount;
    displacements_m_.at(newest_) = displacement_m;
  }
  void reset() { displacements_m_ = {}; }
  // `age` in ticks; 0: the newest.
  [[nodiscard]] double at(std::size_t age) const {
    return displacements_m_.at(newest_ >= age ? newest_ - age : newest_ + kCount - age);
  }

 private:
  static constexpr std::size_t kCount = kMaxEstimatorPoints;

  std::size_t newest_ = 0;
  std::array<double, kCount> displacements_m_{};
};

}  // namespace hapticwall
