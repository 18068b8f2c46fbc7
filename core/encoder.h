// Position sensing: x_k = Δ rint(x/Δ), or x itself where the scene has no encoder.
#pragma once

#include <cmath>

namespace hapticwall {

// rint() without a call: adding and taking away 1.5 * 2^52 rounds to the nearest whole number, ties
// to even, for |value| < 2^51; beyond that it is taken as whole. Realtime-safe: yes.
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

}  // namespace hapticwall
