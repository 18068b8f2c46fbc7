// The colours of a stability map: calm where it settles, hotter the further it swings.
#pragma once

#include <imgui.h>

#include "core/study/stability_map.h"

namespace hapticwall::draw {

// The amplitudes between which the hot colours run, peak to peak; the lower one is the verdict's.
inline constexpr double kHottestM = 0.1;

[[nodiscard]] ImU32 settled_colour();
[[nodiscard]] ImU32 buzzing_colour();
[[nodiscard]] ImU32 oscillating_colour(double tail_peak_to_peak_m);
[[nodiscard]] ImU32 diverged_colour();
[[nodiscard]] ImU32 colour_of(const MapMetrics& figures);

}  // namespace hapticwall::draw
