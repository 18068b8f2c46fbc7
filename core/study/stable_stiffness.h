// The limit of theory for a bare wall: the largest stiffness at which the sampled loop is stable.
#pragma once

#include "core/estimator/velocity_transfer.h"
#include "core/plant/plant_parameters.h"

namespace hapticwall {

// A wall in the hold of a controller, while the handle stays in it: F(k) = K x_k + B v_k acts on
// handle and hand through delay and amplifier, with the velocity v_k of a linear estimator. All
// parts are linear: without friction, encoder, force limit and force resolution.
struct SampledLoop {
  PlantParameters plant;  // friction is not read
  double period_s = 1e-3;
  double delay_s = 0.0;  // from x_k to the arrival of F(k) at the amplifier; may end within a tick
  double wall_damping_n_s_per_m = 0.0;  // B
  VelocityTransfer velocity{};          // the backward difference
};

// The softest unstable wall: all softer ones are stable. 0: the softest walls are unstable,
// although stiffer ones may be stable. Walls beyond the limit may be stable again.
//
// Every crossing of the unit circle is enclosed, so that none is missed. Error below 1e-6 of the
// value, mostly below 1e-10. About 15 to 55 µs without a grip and 30 to 100 µs with one, and 4 µs
// more for each tick of delay beyond 5. Another estimator takes four to seven times as long.
// Realtime-safe: no.
[[nodiscard]] double largest_stable_stiffness(const SampledLoop& loop);

}  // namespace hapticwall
