// Position sensing: x_k = Δ rint(x/Δ), or x itself without an encoder.
#pragma once

#include <cmath>

namespace hapticwall {

// rint() without a call: adding and subtracting 1.5 * 2^52 rounds to the nearest whole number, ties
// to even, for |value| < 2^51. Larger values are returned unchanged. Realtime-safe: yes.
[[nodiscard]] inline double round_to_even(double value) {
  constexpr double kReach = 2251799813685248.0;  // 2^51
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52
  if (!(std::abs(value) < kReach)) return value;
  return (value + kShift) - kShift;
}

// `resolution_m` > 0. Ties go to the even count. Realtime-safe: yes.
[[nodiscard]] inline double quantise(double position_m, double resolution_m) {
  return resolution_m * round_to_even(position_m / resolution_m);
}

// An encoder that remembers its last count and divides only when the position may have left it.
// Same bits as quantise() for |position| ≤ 1 m. Realtime-safe: yes.
class CountingEncoder {
 public:
  // `resolution_m`: at least 1e-12, or 0 for no encoder; read() then is not called.
  explicit CountingEncoder(double resolution_m)
      : resolution_m_(resolution_m), surely_within_m_(resolution_m * kSureFraction - kRounding) {}

  [[nodiscard]] double read(double position_m) {
    if (!(std::abs(position_m - last_m_) < surely_within_m_)) {
      last_m_ = quantise(position_m, resolution_m_);
    }
    return last_m_;
  }

 private:
  // Half a count, less the rounding errors of a position, a quotient and a product.
  static constexpr double kSureFraction = 0.5 - 1e-9;
  static constexpr double kRounding = 1e-15;

  double resolution_m_;
  double surely_within_m_;  // negative for a very fine encoder: then every position is divided
  double last_m_ = 0.0;
};

}  // namespace hapticwall
