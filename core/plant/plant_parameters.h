// The numbers of a plant, as a scene states them.
#pragma once

namespace hapticwall {

// 0 where the scene omits a part.
struct PlantParameters {
  double mass_kg = 1.0;                 // of the handle, with the mass of a hand that has no grip
  double damping_n_s_per_m = 0.0;       // b
  double friction_n = 0.0;              // f_c
  double hand_stiffness_n_per_m = 0.0;  // k_h
  double hand_damping_n_s_per_m = 0.0;  // b_h
  bool grip = false;                    // the hand has a mass and holds the handle by a grip
  double hand_mass_kg = 0.0;            // m_h; this and the grip: with a grip only
  double grip_stiffness_n_per_m = 0.0;  // k_g
  double grip_damping_n_s_per_m = 0.0;  // b_g
  double time_constant_s = 0.0;         // τ of the amplifier

  [[nodiscard]] bool has_friction() const { return friction_n > 0.0; }
  [[nodiscard]] bool has_lag() const { return time_constant_s > 0.0; }
};

}  // namespace hapticwall
