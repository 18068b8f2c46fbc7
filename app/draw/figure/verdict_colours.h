// The colours of verdicts as areas: of the cells of a map. tone.h has those of their words.
#pragma once

#include <imgui.h>

#include "core/summary.h"

namespace hapticwall::draw {

// Calm where it settles. Not for kOscillating, whose colour depends on the amplitude. The same in
// all looks. Any two differ in lightness, so that they are told apart in a print without colours.
[[nodiscard]] ImU32 verdict_area(Verdict verdict);

// The amplitudes between which the hot colours run, peak to peak; the lower one is the verdict's.
inline constexpr double kHottestM = 0.1;
// Hotter and darker the further it swings.
[[nodiscard]] ImU32 oscillating_colour(double tail_peak_to_peak_m);

}  // namespace hapticwall::draw
