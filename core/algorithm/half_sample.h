// Half-sample prediction: the wall's force at the position expected in the middle of the hold.
#pragma once

#include "core/algorithm/algorithm.h"

namespace hapticwall {

// F_d(k) = F_wall(x_k + Δx_k/2, v_k): the walls evaluated half a tick ahead, at p_k + v_k T/2.
//
// The hold delays a spring by half a tick on average, which acts as a negative damper of KT/2. The
// prediction adds K v T/2 and cancels it. The algorithm uses neither energy nor the device's
// damping: it predicts wrongly with a coarse encoder, at a reversal and at an entry within the
// tick, and the rest still chatters. It has no parameters.
//
// Source: Gillespie & Cutkosky, "Stable user-specific haptic rendering of the virtual wall", ASME
// IMECE 1996, in its simplest form; reconstructed.
struct HalfSample {
  static constexpr std::array<SignalDescription, 1> kSignals{
      {{"ahead_penetration_m", "p + v T/2: the penetration half a tick ahead"}}};
  static constexpr AlgorithmDescription kDescription{
      "half-sample",
      "Half-sample prediction",
      "evaluates the wall half a tick ahead, which offsets the delay of the hold",
      {},
      "F_d(k) = K (p + v T/2) + B v  where p + v T/2 > 0, else 0; never negative",
      kSignals};

  void configure(const AlgorithmContext& context) { walls_ = context.walls; }
  void reset() {}

  double step(const AlgorithmInput& in, std::span<double> signals) {
    // Δx/2 in place of v T/2 saves the rounding of a quotient and a product.
    const double ahead_m = 0.5 * in.displacement_m;
    signals[0] = in.penetration_m + ahead_m;
    return evaluate_walls(walls_, in.position_m + ahead_m, in.velocity_m_per_s).force_n;
  }

 private:
  WallSet walls_;
};

}  // namespace hapticwall
