// A virtual mass on a spring: the handle moves an object that has a motion of its own.
#pragma once

#include "core/environment/environment.h"

namespace hapticwall {

// F_e = K (x - m) + B (v - w), with the mass at m and its speed w. After each computation, with the
// period T of the computations,
//
//   w += T F_e/M,  m += T w:
//
// the semi-implicit Euler rule. Its order makes a mass on a spring keep its energy on average; with
// the old w in the second line it would gain some with each swing. The mass gets the force F_e of
// its spring, and not the force that an algorithm makes of it: the environment is then a system of
// its own with the port (x, F_e), as the algorithms assume. With F_d it would not be held by its
// spring any more, and drift away wherever an algorithm holds a force. It begins at rest at the
// handle.
//
// Source: J. M. Brown and J. E. Colgate, "Minimum mass for haptic display simulations", ASME IMECE
// 1998, on how light such a mass may be; cited from memory.
struct VirtualMass {
  static constexpr std::array<ParameterDescription, 3> kParameters{
      number_parameter("mass_kg", "kg", 1e-6, 1e3, "0.5", "M: the virtual mass"),
      number_parameter("stiffness_n_per_m", "N/m", 0.0, 1e6, "1000",
                       "K: of the spring between handle and mass"),
      number_parameter("spring_damping_n_s_per_m", "N·s/m", 0.0, 1e4, "0",
                       "B: of the damper beside the spring")};
  static constexpr std::array<SignalDescription, 1> kSignals{
      {{"mass_position_m", "m: the place of the virtual mass"}}};
  static constexpr EnvironmentDescription kDescription{
      "virtual-mass",
      "Virtual mass",
      "a mass of its own that the handle moves by a spring",
      kParameters,
      "F_e = K (x - m) + B (v - w);  w += T F_e/M,  m += T w",
      kSignals};

  void configure(const EnvironmentContext& context) {
    period_s_ = context.period_s;
    mass_kg_ = context.value_or("mass_kg", 0.5);
    stiffness_n_per_m_ = context.value_or("stiffness_n_per_m", 1000.0);
    damping_n_s_per_m_ = context.value_or("spring_damping_n_s_per_m", 0.0);
  }
  void reset() {
    begun_ = false;
    velocity_m_per_s_ = 0.0;
  }

  // The depth is the way that the spring is compressed.
  [[nodiscard]] WallContact contact(const EnvironmentMotion& motion) const {
    if (!begun_) return {0.0, 0.0, true};
    const double stretch_m = motion.position_m - position_m_;
    return {stiffness_n_per_m_ * stretch_m +
                damping_n_s_per_m_ * (motion.velocity_m_per_s - velocity_m_per_s_),
            stretch_m, true};
  }
  [[nodiscard]] double stiffness_hint(const EnvironmentMotion& /*motion*/) const {
    return stiffness_n_per_m_;
  }
  void advance(const EnvironmentMotion& motion, double /*applied_force_n*/) {
    const double force_n = contact(motion).force_n;
    if (!begun_) {
      begun_ = true;
      position_m_ = motion.position_m;
    }
    velocity_m_per_s_ += period_s_ * force_n / mass_kg_;
    position_m_ += period_s_ * velocity_m_per_s_;
  }
  void show(std::span<double> signals) const {
    if (begun_) signals[0] = position_m_;
  }

 private:
  double period_s_ = 1e-3;
  double mass_kg_ = 1.0;            // M
  double stiffness_n_per_m_ = 0.0;  // K
  double damping_n_s_per_m_ = 0.0;  // B
  bool begun_ = false;
  double position_m_ = 0.0;        // m
  double velocity_m_per_s_ = 0.0;  // w
};

}  // namespace hapticwall
