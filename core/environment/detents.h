// Detents: a periodic potential, as of a knob that clicks.
#pragma once

#include <cmath>

#include "core/environment/environment.h"
#include "core/environment/portable_math.h"

namespace hapticwall {

// F_e = A sin(2π (x - x_0)/λ), the slope of U = (A λ/2π) (1 - cos(2π (x - x_0)/λ)): the handle
// rests at x_0 and every λ from there. It pulls as well as it pushes, and stores without a loss.
//
// Source: a pendulum's potential; the force of a detent is often drawn so in haptic knobs.
struct Detents {
  static constexpr std::array<ParameterDescription, 3> kParameters{
      kEnvironmentPosition,
      number_parameter("detent_force_n", "N", 0.0, 1e3, "2",
                       "A: the largest force, a quarter of the spacing off a detent"),
      number_parameter("spacing_m", "m", 1e-5, 1.0, "0.01", "λ: from a detent to the next one")};
  static constexpr EnvironmentDescription kDescription{"detents", "Detents",
                                                       "holds the handle at equally spaced places",
                                                       kParameters, "F_e = A sin(2π (x - x_0)/λ)"};

  void configure(const EnvironmentContext& context) {
    position_m_ = context.value_or("position_m", kDefaultEnvironmentPositionM);
    force_n_ = context.value_or("detent_force_n", 2.0);
    spacing_m_ = context.value_or("spacing_m", 0.01);
  }
  void reset() {}

  // The depth is the signed way to the nearest detent.
  [[nodiscard]] WallContact contact(const EnvironmentMotion& motion) const {
    const double turns = (motion.position_m - position_m_) / spacing_m_;
    const double from_detent = turns - std::floor(turns + 0.5);
    return {force_n_ * sine_of_turns(turns), from_detent * spacing_m_, true};
  }
  // The steepest slope, at a detent.
  [[nodiscard]] double stiffness_hint(const EnvironmentMotion& /*motion*/) const {
    constexpr double kTwoPi = 6.283185307179586;
    return kTwoPi * force_n_ / spacing_m_;
  }

 private:
  double position_m_ = 0.0;
  double force_n_ = 0.0;
  double spacing_m_ = 1.0;
};

}  // namespace hapticwall
