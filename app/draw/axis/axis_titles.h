// Titles of the axes of a printed plot, in the current font.
#pragma once

#include <imgui.h>

#include <string>

namespace hapticwall::draw {

// Room that an upright title takes beside a plot of this height, in pixels: of one line, or of two
// if it is longer than the plot is high.
[[nodiscard]] float title_room(const std::string& title, float height);

// The upright title in the middle of [top, top + height], from `left` on, in `room` pixels of
// title_room().
void draw_upright_title(ImU32 colour, const std::string& title, float left, float room, float top,
                        float height);

// The title below the middle of an axis that begins at `left`, at the cursor's height, as an item.
void draw_title_below(ImU32 colour, const std::string& title, float left, float width);

}  // namespace hapticwall::draw
