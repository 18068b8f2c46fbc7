// What theory says of the stiffest wall that a device can render by itself, without any of the
// algorithms: lines to draw and to test against, not limits that anything here enforces.
#pragma once

#include <optional>

#include "core/scene.h"

namespace hapticwall {

// Largest stiffnesses of a wall, N/m; absent where the scene names nothing that would limit it.
struct StabilityBounds {
  // Passive whatever the hand does: b >= K T / 2 + B (Colgate and Schenkel). 0 where the wall's own
  // damping takes all of the device's.
  std::optional<double> passive_n_per_m;
  // Stable against a hand that only adds mass, with a delay t_d between a position and the force
  // that follows from it: K < (b + B) / (T / 2 + t_d) (Gil, Diolaiti and others).
  std::optional<double> delayed_n_per_m;
  // With an encoder and Coulomb friction: K <= 2 f_c / Delta (Abbott and Okamura 2005).
  std::optional<double> friction_n_per_m;
  // The force limit within one count: K <= F_max / Delta. More cannot be told from a switch.
  std::optional<double> resolution_n_per_m;
};

// `delay_s` >= 0, from the latch of a position to the force that follows from it, the hold's half
// tick not counted: for a simulator delay_of(), for a real device what was measured.
// Realtime-safe: yes.
[[nodiscard]] StabilityBounds stability_bounds(const Scene& scene, const WallSettings& wall,
                                               double delay_s);

// Of a simulated device: its whole ticks, and the time constant of its amplifier. Seconds.
[[nodiscard]] double delay_of(const Scene& scene);

}  // namespace hapticwall
