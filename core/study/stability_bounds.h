// Theoretical limits of the bare wall, without an algorithm. They are drawn and tested against;
// nothing enforces them.
#pragma once

#include <optional>

#include "core/scene.h"

namespace hapticwall {

// Largest stiffnesses; nullopt if no part of the scene limits them.
struct StabilityBounds {
  // Passive for any hand: b >= K T / 2 + B (Colgate and Schenkel). 0 if B >= b.
  std::optional<double> passive_n_per_m;
  // Stable for a hand that only adds mass, with a delay t_d from a position to its force:
  // K < (b + B) / (T / 2 + t_d) (Gil; Hulin).
  std::optional<double> delayed_n_per_m;
  // With an encoder and Coulomb friction: K <= 2 f_c / Delta (Abbott and Okamura 2005).
  std::optional<double> friction_n_per_m;
  // Force limit within one count: K <= F_max / Delta. A stiffer wall acts like a switch.
  std::optional<double> resolution_n_per_m;
};

// `delay_s` >= 0, from the latch of a position to its force, without the half tick of the hold:
// delay_of() for a simulator, the measured delay for a real device. Realtime-safe: yes.
[[nodiscard]] StabilityBounds stability_bounds(const Scene& scene, const WallSettings& wall,
                                               double delay_s);

// Of a simulated device: its delay in ticks plus the time constant of its amplifier. Seconds.
[[nodiscard]] double delay_of(const Scene& scene);

}  // namespace hapticwall
