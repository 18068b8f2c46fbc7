// The backward difference: displacement over period.
#pragma once

#include "core/estimator/estimator.h"

namespace hapticwall {

// v_k = (x_k - x_{k-1})/T: an encoder of step Δ shows multiples of Δ/T.
struct BackwardDifference {
  static constexpr EstimatorDescription kDescription{
      "backward-difference",
      "Backward difference",
      "divides the displacement of a tick by the period",
      {},
      "v_k = (x_k - x_{k-1})/T"};

  void configure(const EstimatorContext& context) { rate_hz_ = context.rate_hz; }
  void reset() {}
  [[nodiscard]] double velocity(double /*position_m*/, double displacement_m) const {
    return displacement_m * rate_hz_;
  }

  static VelocityTransfer transfer(const EstimatorContext& /*context*/) { return {}; }

 private:
  double rate_hz_ = 0.0;
};

}  // namespace hapticwall
