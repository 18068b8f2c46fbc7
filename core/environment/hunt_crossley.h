// The contact of Hunt and Crossley: a spring and a damper that are both nonlinear.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/environment/environment.h"
#include "core/scene_keys.h"

namespace hapticwall {

// F_e = max(0, F_0 (p/p_0)^n (1 + D v)) while p > 0: soft at the surface, stiffer with the depth.
// The damper λ p^n v = D k p^n v is 0 at the surface, so that neither touch nor departure makes a
// step of force; k = F_0/p_0^n. n = 1.5 is Hertz's contact of a ball; soft tissue has 1 to 3.
//
// The exponent is a multiple of 1/4: the power then consists of products and square roots, whose
// rounding is the same everywhere.
//
// Source: K. H. Hunt and F. R. E. Crossley, "Coefficient of restitution interpreted as damping in
// vibroimpact", J. Applied Mechanics 42(2), 1975; cited from memory.
struct HuntCrossley {
  static constexpr std::array<ParameterDescription, 5> kParameters{
      kEnvironmentPosition,
      number_parameter("reference_force_n", "N", 0.0, 1e6, "5",
                       "F_0: the force at the reference depth, at rest"),
      number_parameter("reference_depth_m", "m", 1e-6, 1.0, "0.01", "p_0: the reference depth"),
      number_parameter("exponent", "", 1.0, 4.0, "1.5",
                       "n, a multiple of 0.25: 1 is a spring, 1.5 Hertz's contact of a ball"),
      number_parameter("dissipation_s_per_m", "s/m", 0.0, 100.0, "0.5",
                       "D: the share of the force that a speed of 1 m/s adds")};
  static constexpr EnvironmentDescription kDescription{
      "hunt-crossley", "Hunt-Crossley contact",
      "a spring and a damper that grow with the depth, as soft tissue does", kParameters,
      "F_e = F_0 (p/p_0)^n (1 + D v)  where p > 0, else 0; never negative"};

  static std::optional<SceneProblem> problem(const EnvironmentContext& context) {
    const double exponent = context.value_or("exponent", 1.5);
    if (4.0 * exponent == std::floor(4.0 * exponent)) return std::nullopt;
    return SceneProblem{"environment.exponent", number_text(exponent) + " is no multiple of 0.25"};
  }

  void configure(const EnvironmentContext& context) {
    surface_m_ = context.value_or("position_m", kDefaultEnvironmentPositionM);
    force_n_ = context.value_or("reference_force_n", 5.0);
    depth_m_ = context.value_or("reference_depth_m", 0.01);
    quarters_ = static_cast<int>(4.0 * context.value_or("exponent", 1.5));
    dissipation_s_per_m_ = context.value_or("dissipation_s_per_m", 0.5);
  }
  void reset() {}

  [[nodiscard]] WallContact contact(const EnvironmentMotion& motion) const {
    const double depth_m = motion.position_m - surface_m_;
    if (!(depth_m > 0.0)) return {0.0, depth_m, false};
    const double factor = 1.0 + dissipation_s_per_m_ * motion.velocity_m_per_s;
    return {std::max(0.0, spring_n(depth_m) * factor), depth_m, true};
  }
  // The secant F/p: the spring that holds the same force at this depth.
  [[nodiscard]] double stiffness_hint(const EnvironmentMotion& motion) const {
    const double depth_m = motion.position_m - surface_m_;
    return depth_m > 0.0 ? spring_n(depth_m) / depth_m : 0.0;
  }

 private:
  [[nodiscard]] double spring_n(double depth_m) const {
    const double ratio = depth_m / depth_m_;
    double power = 1.0;
    for (int i = 0; i < quarters_ / 4; ++i) power *= ratio;
    const double root = std::sqrt(ratio);
    if (quarters_ % 4 >= 2) power *= root;
    if (quarters_ % 2 == 1) power *= std::sqrt(root);
    return force_n_ * power;
  }

  double surface_m_ = 0.0;
  double force_n_ = 0.0;              // F_0
  double depth_m_ = 1.0;              // p_0
  int quarters_ = 6;                  // 4n
  double dissipation_s_per_m_ = 0.0;  // D
};

}  // namespace hapticwall
