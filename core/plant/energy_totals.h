// Energy that the plant has exchanged since the start, joules. `Real` is the plant's number type:
// double, or long double in the reference.
#pragma once

namespace hapticwall {

template <typename Real>
struct BasicEnergyTotals {
  Real actuator_work_j = 0;  // ∫ F_a v dt, F_a the force really acting
  Real viscous_j = 0;        // ∫ b v² dt in the device
  Real friction_j = 0;       // ∫ f_c |v| dt in the device
  Real hand_work_j = 0;      // ∫ F_h v dt, of the hand on the handle

  [[nodiscard]] Real dissipation_j() const { return viscous_j + friction_j; }
};
using EnergyTotals = BasicEnergyTotals<double>;

// Displacement and energies of a stretch of motion.
template <typename Real>
struct MotionIncrement {
  Real displacement_m = 0;    // of the handle
  Real velocity_squared = 0;  // ∫ v² dt, m²/s
  Real hand_work_j = 0;
  Real lag_work_j = 0;  // ∫ (F_a - F) v dt: an amplifier's lag adds it to the work of the force F
};

// The hand's intention during a stretch of motion: position at its begin and constant speed.
template <typename Real>
struct BasicHandDrive {
  Real position_m = 0;
  Real velocity_m_per_s = 0;
};
using HandDrive = BasicHandDrive<double>;

// The force on the handle, constant over a stretch.
template <typename Real>
struct Load {
  Real force_n = 0;  // commanded to the actuator
  Real total_n = 0;  // with the friction of the present direction
};

}  // namespace hapticwall
