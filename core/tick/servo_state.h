// What the loop of an axis keeps from tick to tick.
#pragma once

#include <cstdint>

#include "core/tick/energy_ledger.h"

namespace hapticwall {

// After a switch the force starts at its last value: the difference to the new algorithm's force is
// an offset that falls linearly to 0.
struct SwitchTransition {
  std::uint32_t ticks_left = 0;
  std::uint32_t ticks_total = 0;
  double offset_n = 0.0;
  bool offset_known = false;

  // The force of this tick. Precondition: ticks_left > 0. Realtime-safe: yes.
  [[nodiscard]] double blend(double force_n, double previous_force_n) {
    if (!offset_known) {
      offset_n = previous_force_n - force_n;
      offset_known = true;
    }
    const double weight = static_cast<double>(ticks_left) / static_cast<double>(ticks_total);
    --ticks_left;
    return force_n + weight * offset_n;
  }
};

// The last computation of a controller that skips ticks.
struct LastComputation {
  double displacement_m = 0.0;  // since then
  double velocity_m_per_s = 0.0;
  double wanted_n = 0.0;
  bool intervened = false;
  // The next tick computes in any case: the first one, after a change, and after a fault.
  bool outdated = true;
};

struct ServoState {
  std::uint64_t tick = 0;
  double previous_position_m = 0.0;
  double previous_force_n = 0.0;
  double budget_n_per_m = 0.0;  // b/T, b as the algorithm believes it
  EnergyLedger ledger;
  SwitchTransition transition;
  LastComputation last;  // only of a loop that skips ticks
  // Share of the force that reaches the device, 0 to 1; below 1 until it is fully armed.
  double force_gain = 1.0;
  double previous_gain = 1.0;  // of the previous force
  // Shares until a device has obeyed: of the force limit, and of the force within it, above 0. The
  // algorithm does not see the second one.
  double limit_share = 1.0;
  double level = 1.0;
  double previous_level = 1.0;  // of the previous force
  bool position_known = false;  // the last reading was without fault
  bool parameters_changed = false;
  bool failed = false;  // a force that was not finite; sticky until reset
};

}  // namespace hapticwall
