// What the plant has exchanged since the start, joules.
#pragma once

namespace hapticwall {

struct EnergyTotals {
  double actuator_work_j = 0.0;  // ∫ F_d v dt
  double viscous_j = 0.0;        // ∫ b v² dt in the device
  double friction_j = 0.0;       // ∫ f_c |v| dt in the device
  double hand_work_j = 0.0;      // ∫ F_h v dt, of the hand on the handle

  [[nodiscard]] double dissipation_j() const { return viscous_j + friction_j; }
};

// What a stretch of motion moves and exchanges.
struct MotionIncrement {
  double displacement_m = 0.0;    // of the handle
  double velocity_squared = 0.0;  // ∫ v² dt, m²/s
  double hand_work_j = 0.0;
};

// The hand's intention during a stretch of motion: position at its begin and constant speed.
struct HandDrive {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
};

}  // namespace hapticwall
