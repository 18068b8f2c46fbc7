// How the loop and the window keep their time: histograms, figures, a verdict in words.
#pragma once

#include <string>

#include "app/ui/timing_state.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// "The loop keeps its time: p99 14 µs late of a 1000 µs period." `tone`: of the words.
[[nodiscard]] std::string timing_sentence(const TimingState& timing, double rate_hz, Tone& tone);

// Fills what is left of the current window.
void draw_timing_page(const PanelContext& context);

}  // namespace hapticwall::ui
