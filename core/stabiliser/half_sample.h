// Half-sample prediction: the wall is where the handle will be in the middle of the hold.
#pragma once

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// F_d(k) = F_wall(x_k + Δx_k/2, v_k): the walls evaluated half a tick ahead, at p_k + v_k T/2.
//
// The hold delays a spring by half a tick on average, which is a negative damper of KT/2; the
// prediction adds K v T/2, which takes it away. It knows nothing of energy and of the device: a
// coarse encoder, a reversal or an entry within the tick is predicted wrongly, and what is left
// over still chatters. It has no parameters.
//
// Source: Gillespie & Cutkosky, "Stable user-specific haptic rendering of the virtual wall", ASME
// IMECE 1996, in its simplest form; reconstructed. Realtime-safe: yes.
class HalfSample {
 public:
  static constexpr AlgorithmDescription kDescription{
      "half-sample",
      "Half-sample prediction",
      "evaluates the wall half a tick ahead, which offsets the delay of the hold",
      {},
      "F_d(k) = K (p + v T/2) + B v  where p + v T/2 > 0, else 0; never negative"};

  void configure(const StabiliserContext& context) { walls_ = context.walls; }
  void reset() {}

  [[nodiscard]] double step(const StabiliserInput& input) const {
    // v_k T/2 without the rounding of a quotient and a product.
    const double ahead_m = input.position_m + 0.5 * input.displacement_m;
    return evaluate_walls(walls_, ahead_m, input.velocity_m_per_s).force_n;
  }

 private:
  WallSet walls_;
};

}  // namespace hapticwall
