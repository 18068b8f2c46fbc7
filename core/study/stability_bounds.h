// Theoretical limits of the bare wall, without an algorithm. They are drawn and tested against;
// nothing enforces them.
#pragma once

#include <optional>

#include "core/scene.h"

namespace hapticwall {

// Largest stiffnesses; nullopt if no part of the scene limits them, or if the theory does not know
// the scene's estimator of velocity.
struct StabilityBounds {
  // Passive for any hand: b >= K T / 2 + B (Colgate and Schenkel). 0 if B >= b. With a damper only
  // under the backward difference. T is the period of the controller's computations here and below.
  std::optional<double> passive_n_per_m;
  // All softer walls are stable with the scene's hand, delay, amplifier and linear estimator:
  // largest_stable_stiffness(). 0: the softest walls are not. With lost ticks or jitter in the mean
  // square (mean_square_stiffness()), and the other limits of the loop are unknown.
  std::optional<double> stable_n_per_m;
  // The rule of thumb for the same, for a hand that only adds mass: K < (b + B) / (T / 2 + t_d)
  // (Gil; Hulin), under the backward difference. Too high by at most 16 % up to kMaxRuleDamping and
  // two ticks of delay.
  std::optional<double> rule_n_per_m;
  // Limit with an encoder and Coulomb friction: K <= 2 f_c / Delta (Abbott and Okamura 2005).
  std::optional<double> friction_n_per_m;
  // Force limit within one count: K <= F_max / Delta. A stiffer wall acts like a switch.
  std::optional<double> resolution_n_per_m;
};

inline constexpr double kMaxRuleDamping = 0.1;  // B T/m

// Delay from the latch of a position to its force, without the half tick of the hold; each at least
// 0.
struct LoopDelay {
  double transport_s = 0.0;      // whole ticks of a simulator; as measured of a real device
  double time_constant_s = 0.0;  // of the amplifier; 0 if the measured delay contains it

  [[nodiscard]] double total_s() const { return transport_s + time_constant_s; }
};

// Bounds of the wall by itself: other walls that it may overlap do not count. For a real device,
// whose hand is unknown, the scene has none. For the cost see stable_stiffness.h. Realtime-safe:
// no.
[[nodiscard]] StabilityBounds stability_bounds(const Scene& scene, const WallSettings& wall,
                                               const LoopDelay& delay);

// The stable limit of the loop that the scene simulates, on axis x. nullopt if the loop is not the
// linear one of the limit: with several walls, another algorithm than "none", a follower, a
// nonlinear estimator, friction, an encoder, a force resolution or another integrator than the
// exact one. The limits of the force and of its rate act on large swings only. Realtime-safe: no.
[[nodiscard]] std::optional<double> exact_stable_limit(const Scene& scene);

// Delay of a simulated device: the whole ticks and the time constant of axis x. Realtime-safe: yes.
[[nodiscard]] LoopDelay delay_of(const Scene& scene);

}  // namespace hapticwall
