// Half-sample prediction: the wall's force at the position expected in the middle of the hold.
#pragma once

#include "core/algorithm/algorithm.h"
#include "core/environment/active_environment.h"

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

  void configure(const AlgorithmContext& context) {
    period_s_ = context.period_s;
    walls_ = context.walls;
  }
  void reset() {}

  double step(const AlgorithmInput& in, std::span<double> signals) {
    // Δx/2 in place of v T/2 saves the rounding of a quotient and a product.
    const double ahead_m = 0.5 * in.displacement_m;
    signals[0] = in.penetration_m + ahead_m;
    if (in.environment != nullptr) return force_of_environment(*in.environment, in, ahead_m);
    return evaluate_walls(walls_, in.position_m + ahead_m, in.velocity_m_per_s).force_n;
  }

 private:
  // Both axes move on by half a tick: the motion of the other one is its velocity times T/2.
  [[nodiscard]] double force_of_environment(const ActiveEnvironment& environment,
                                            const AlgorithmInput& in, double ahead_m) const {
    EnvironmentMotion motion = environment.motion();
    motion.position_m = in.position_m + ahead_m;
    motion.other_position_m += 0.5 * period_s_ * motion.other_velocity_m_per_s;
    return environment.contact_at(motion).force_n;
  }

  double period_s_ = 0.0;
  WallSet walls_;
};

}  // namespace hapticwall
