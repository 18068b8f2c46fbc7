// A bump: a hill on the plane of two axes, felt by the force of its slope.
#pragma once

#include "core/environment/environment.h"
#include "core/environment/portable_math.h"

namespace hapticwall {

// The hill h = H exp(-r²/2σ²) has the energy U = A h under a weight A, and the force of each axis
// is F_e = A ∂h/∂x_i = -A h (x_i - c_i)/σ²: it pushes back uphill and pulls downhill, towards the
// foot. U depends on the place alone, so that a closed path takes no work. With one axis the hill
// is a ridge across it.
//
// Source: the lateral force of a slope, G. Robles-De-La-Torre and V. Hayward, "Force can overcome
// object geometry in the perception of shape through active touch", Nature 412, 2001; cited from
// memory. The Gaussian is a choice: smooth, and the same in all directions.
struct Bump {
  static constexpr std::array<ParameterDescription, 5> kParameters{
      number_parameter("centre_x_m", "m", -1.0, 1.0, "0.05", "c: the top on axis x"),
      number_parameter("centre_y_m", "m", -1.0, 1.0, "0.05", "c: the top on axis y"),
      number_parameter("height_m", "m", 0.0, 1.0, "0.005", "H: the height of the top"),
      number_parameter("width_m", "m", 1e-5, 1.0, "0.008",
                       "σ: the distance of the steepest slope from the top"),
      number_parameter("weight_n", "N", 0.0, 1e3, "10",
                       "A: the force that presses on the hill; times a slope it is the force")};
  static constexpr EnvironmentDescription kDescription{
      "bump", "Bump", "a hill on the plane of two axes, felt by its slope", kParameters,
      "F_e = A ∂h/∂x,  h = H exp(-r²/2σ²)"};

  void configure(const EnvironmentContext& context) {
    const bool on_x = context.axis == 0;
    centre_m_ = context.value_or(on_x ? "centre_x_m" : "centre_y_m", kDefaultEnvironmentPositionM);
    other_centre_m_ =
        context.value_or(on_x ? "centre_y_m" : "centre_x_m", kDefaultEnvironmentPositionM);
    height_m_ = context.value_or("height_m", 0.005);
    width_m_ = context.value_or("width_m", 0.008);
    weight_n_ = context.value_or("weight_n", 10.0);
  }
  void reset() {}

  // The depth is the height of the hill under the handle; a contact is within four widths of the
  // top.
  [[nodiscard]] WallContact contact(const EnvironmentMotion& motion) const {
    const double away = (motion.position_m - centre_m_) / width_m_;
    const double beside =
        motion.two_axes ? (motion.other_position_m - other_centre_m_) / width_m_ : 0.0;
    const double square = away * away + beside * beside;
    const double height_m = height_m_ * exp_of_minus(0.5 * square);
    return {-weight_n_ * height_m / width_m_ * away, height_m, square < 16.0};
  }
  // The steepest change of the force, at the top, where it is a spring that pushes away.
  [[nodiscard]] double stiffness_hint(const EnvironmentMotion& /*motion*/) const {
    return weight_n_ * height_m_ / (width_m_ * width_m_);
  }

 private:
  double centre_m_ = 0.0;
  double other_centre_m_ = 0.0;
  double height_m_ = 0.0;  // H
  double width_m_ = 1.0;   // σ
  double weight_n_ = 0.0;  // A
};

}  // namespace hapticwall
