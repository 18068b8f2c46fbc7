// The backward difference: displacement over period.
#pragma once

#include <string_view>

namespace hapticwall {

// v_k = (x_k - x_{k-1})/T: an encoder of step Δ shows multiples of Δ/T.
struct BackwardDifference {
  static constexpr std::string_view kName = "backward-difference";

  void configure(double rate_hz) { rate_hz_ = rate_hz; }
  void reset() {}
  [[nodiscard]] double velocity(double /*position_m*/, double displacement_m) const {
    return displacement_m * rate_hz_;
  }

 private:
  double rate_hz_ = 0.0;
};

}  // namespace hapticwall
