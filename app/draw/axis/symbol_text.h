// Text with subscripts: "F_max (N)" has a small, low "max". And upright text, for axis titles.
#pragma once

#include <imgui.h>

#include <string_view>

namespace hapticwall::draw {

// Size in the current font. An underscore after one letter begins a subscript, which ends with its
// letters and digits.
[[nodiscard]] ImVec2 symbol_text_size(std::string_view text);

// Draws with the current font; `corner` is the upper left one.
void add_symbol_text(ImDrawList& list, ImVec2 corner, ImU32 colour, std::string_view text);

// The same, turned to the left: it begins at `corner`, the lower left one, and goes up.
void add_upright_text(ImDrawList& list, ImVec2 corner, ImU32 colour, std::string_view text);

// The text as an item, at the cursor.
void symbol_text(ImU32 colour, std::string_view text);

// The text in as many lines as the region needs. A line breaks at "  ·  " where possible, and never
// between a number and its unit.
void wrapped_symbol_text(ImU32 colour, std::string_view text);

}  // namespace hapticwall::draw
