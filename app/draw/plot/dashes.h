// Broken lines, so that two lines differ by more than their colour.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <span>

namespace hapticwall::draw {

enum class Dash : std::uint8_t { kSolid, kDashed, kDotted, kDashDot };

// The line through the points, in pixels, `weight` pixels thick. `scale` is that of the content. A
// point that is not a number is a gap.
void draw_dashed(ImDrawList* list, std::span<const ImVec2> points, ImU32 colour, float weight,
                 Dash dash, float scale);

}  // namespace hapticwall::draw
