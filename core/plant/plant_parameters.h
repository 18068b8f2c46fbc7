// The numbers of a plant, as a scene states them.
#pragma once

namespace hapticwall {

// 0 where the scene omits a part.
struct PlantParameters {
  double mass_kg = 1.0;                 // of the handle, with the mass of a hand that has no grip
  double damping_n_s_per_m = 0.0;       // b
  double friction_n = 0.0;              // f_c
  double static_friction_n = 0.0;       // f_s; 0, or at least f_c
  double stribeck_speed_m_per_s = 0.0;  // v_s; above 0 with f_s
  double hand_stiffness_n_per_m = 0.0;  // k_h
  double hand_damping_n_s_per_m = 0.0;  // b_h
  bool grip = false;                    // the hand has a mass and holds the handle by a grip
  double hand_mass_kg = 0.0;            // m_h; this and the grip: with a grip only
  double grip_stiffness_n_per_m = 0.0;  // k_g
  double grip_damping_n_s_per_m = 0.0;  // b_g
  double time_constant_s = 0.0;         // τ of the amplifier

  [[nodiscard]] bool has_friction() const { return friction_n > 0.0 || has_stribeck(); }
  [[nodiscard]] bool has_stribeck() const { return static_friction_n > 0.0; }
  // f_c + (f_s - f_c)/(1 + (v/v_s)²), newtons (Hess and Soom 1990). The quotient gives the same
  // bits on every machine; the exponential of other authors does not.
  [[nodiscard]] double friction_at_n(double velocity_m_per_s) const {
    if (!has_stribeck()) return friction_n;
    const double ratio = velocity_m_per_s / stribeck_speed_m_per_s;
    return friction_n + (static_friction_n - friction_n) / (1.0 + ratio * ratio);
  }
  [[nodiscard]] bool has_lag() const { return time_constant_s > 0.0; }
};

}  // namespace hapticwall
