// One tick as it is plotted and recorded. Trivially copyable; SI units throughout.
#pragma once

#include <cstdint>

namespace hapticwall {

enum SampleFlag : std::uint32_t {
  kFlagInContact = 1,
  kFlagForceLimit = 2,
  kFlagIntervened = 4,  // the algorithm's force differs from the wall's
  kFlagStaleInput = 8,
  kFlagParametersChanged = 16,  // first tick that uses new parameters
  kFlagDeviceFault = 32,
};

// What only a simulator knows, at the instant of the tick, before its force acts.
struct PlantTruth {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double hand_path_m = 0.0;   // intended position; the handle's start where there is no hand
  double hand_force_n = 0.0;  // of the hand on the handle
  double actuator_work_j = 0.0;
  double dissipation_j = 0.0;
  double hand_work_j = 0.0;
  double kinetic_j = 0.0;
};

struct Sample {
  std::uint64_t tick = 0;   // since the last reset
  double time_s = 0.0;      // tick / rate
  double position_m = 0.0;  // as measured
  double velocity_m_per_s = 0.0;
  double penetration_m = 0.0;
  double wall_force_n = 0.0;       // F_e
  double force_n = 0.0;            // F_d
  double stiffness_n_per_m = 0.0;  // F_d / penetration; 0 out of contact
  double energy_cv_j = 0.0;        // Eq. 6, the passivity observer
  double energy_hold_j = 0.0;      // Eq. 9
  double energy_scv_j = 0.0;       // Eq. 10
  double energy_budget_j = 0.0;    // -T Σ b v²
  PlantTruth truth;
  // Only a real device's: when the position was latched, by its own clock since it was opened, and
  // how old the position was when it was acted upon. 0 from the simulator.
  double device_time_s = 0.0;
  double read_age_s = 0.0;
  std::uint32_t flags = 0;
  std::uint32_t generation = 0;  // of the parameters in force (live sessions; 0 in headless runs)
};

}  // namespace hapticwall
