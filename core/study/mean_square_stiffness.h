// The limit of a bare wall whose controller computes at random times.
#pragma once

#include <optional>

#include "core/scene.h"
#include "core/study/stable_stiffness.h"

namespace hapticwall {

// The softest wall with which the mean square of the motion grows, N/m; all softer ones are stable
// in this sense. A single run may calm down beyond it, and a run below it may swing far before it
// does. 0: the softest walls grow.
//
// `loop` has the period of a tick; its estimator that of the controller's computations. Lost ticks,
// jitter and skipped ticks are those of `sampling`. nullopt: a delay that ends within a tick, a
// loop of more than twelve states, or no limit below four times that of the same loop without
// chance. Error below 1e-6 of the value. 1 ms for a handle, 0.3 s for twelve states. Realtime-safe:
// no.
[[nodiscard]] std::optional<double> mean_square_stiffness(const SampledLoop& loop,
                                                          const SamplingSettings& sampling);

}  // namespace hapticwall
