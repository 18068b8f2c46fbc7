// Broken lines, so that two lines differ by more than their colour.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <span>
#include <vector>

namespace hapticwall::draw {

enum class Dash : std::uint8_t { kSolid, kDashed, kDotted, kDashDot };

// The line through the points, in pixels, `weight` pixels thick. `scale` is that of the content. A
// point that is not a number is a gap.
void draw_dashed(ImDrawList* list, std::span<const ImVec2> points, ImU32 colour, float weight,
                 Dash dash, float scale);

// Drops points that the straight line between the kept ones passes within a fifth of a pixel. Ends,
// turns and gaps stay.
void keep_bends(std::vector<ImVec2>& points);

}  // namespace hapticwall::draw
