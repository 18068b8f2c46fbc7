// The timing page: histograms, quantiles and a verdict for loop and window.
#pragma once

#include <string>

#include "app/ui/state/panel_context.h"
#include "app/ui/state/timing_state.h"

namespace hapticwall::ui {

// "The loop meets its deadlines: p99 14 µs late of a 1000 µs period." `tone`: of the words.
[[nodiscard]] std::string timing_sentence(const TimingState& timing, double rate_hz,
                                          draw::Tone& tone);

// Fills the rest of the current window.
void draw_timing_page(const PanelContext& context);

}  // namespace hapticwall::ui
