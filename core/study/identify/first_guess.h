// Starting values for a fit by modulating functions: integrals of the record with a smooth window
// in the place of derivatives of a noisy position. A linear least-squares problem for each delay.
#pragma once

#include <cstddef>
#include <vector>

#include "core/study/identify/handle_model.h"

namespace hapticwall::identify {

struct Guess {
  double delay_s = 0.0;  // of a force, with the lag
  // Squared error of the windowed equations. It compares guesses of one record only.
  double residual = 0.0;
  Parameters parameters{};  // without a lag
};

// The best guesses over delays of 0 to `max_delay_ticks`, best first. Ticks before `first_tick` are
// not read. Empty if the record has too few strokes. Errors up to 30 %.
// Realtime-safe: no.
[[nodiscard]] std::vector<Guess> first_guesses(const Record& record, std::size_t first_tick,
                                               double max_delay_ticks);

// Ticks of the extremes at which the position turned by at least `hysteresis_m`. The first stretch
// has no extreme before it, and the last one none after it. Realtime-safe: no.
[[nodiscard]] std::vector<std::size_t> turns(const Record& record, std::size_t first_tick,
                                             double hysteresis_m);

}  // namespace hapticwall::identify
