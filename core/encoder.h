// Position sensing: x_k = Δ rint(x/Δ), or x itself where the scene has no encoder.
#pragma once

#include <cmath>

namespace hapticwall {

// `resolution_m` > 0. Ties go to the even count (rint). Realtime-safe: yes.
[[nodiscard]] inline double quantise(double position_m, double resolution_m) {
  return resolution_m * std::rint(position_m / resolution_m);
}

}  // namespace hapticwall
