// Keys of a legend in as many lines as they need.
#pragma once

#include <imgui.h>

#include <string_view>

namespace hapticwall::draw {

// Starts a new line if a key of this width does not fit beside the previous one.
void begin_key(float width);

// The text of a key; one that is too long has lines of its own. The next item stands `gap` pixels
// beside it.
void draw_key_text(ImU32 colour, std::string_view text, float gap);

}  // namespace hapticwall::draw
