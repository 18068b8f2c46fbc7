// What the plant has exchanged since the start, joules. `Real` is the number that the plant
// computes with: double, or long double in the reference.
#pragma once

namespace hapticwall {

template <typename Real>
struct BasicEnergyTotals {
  Real actuator_work_j = 0;  // ∫ F_a v dt, F_a the force that really acts
  Real viscous_j = 0;        // ∫ b v² dt in the device
  Real friction_j = 0;       // ∫ f_c |v| dt in the device
  Real hand_work_j = 0;      // ∫ F_h v dt, of the hand on the handle

  [[nodiscard]] Real dissipation_j() const { return viscous_j + friction_j; }
};
using EnergyTotals = BasicEnergyTotals<double>;

// What a stretch of motion moves and exchanges.
template <typename Real>
struct MotionIncrement {
  Real displacement_m = 0;    // of the handle
  Real velocity_squared = 0;  // ∫ v² dt, m²/s
  Real hand_work_j = 0;
  Real lag_work_j = 0;  // ∫ (F_a - F) v dt: what an amplifier's lag adds to the work of the force F
};

// The hand's intention during a stretch of motion: position at its begin and constant speed.
template <typename Real>
struct BasicHandDrive {
  Real position_m = 0;
  Real velocity_m_per_s = 0;
};
using HandDrive = BasicHandDrive<double>;

// What acts on the handle against its motion, constant over a stretch.
template <typename Real>
struct Load {
  Real force_n = 0;  // that the actuator is told to give
  Real total_n = 0;  // with the friction of the present direction
};

}  // namespace hapticwall
