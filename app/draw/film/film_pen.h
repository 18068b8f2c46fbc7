// Text and boxes of a film's pictures, at one scale.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

#include "app/draw/plot/plot_labels.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {

// Sizes of text in pixels at scale 1, for a picture of 720 lines.
inline constexpr float kVerdictFontSize = 62.0F;
inline constexpr float kNameFontSize = 24.0F;
inline constexpr float kDetailFontSize = 22.0F;
inline constexpr float kNoteFontSize = 16.0F;

struct FilmPen {
  const Theme& theme;
  ImDrawList* list = nullptr;
  float scale = 1.0F;

  // Width of a text in pixels.
  [[nodiscard]] float width(std::string_view words, float size, ImFont* font) const;
  void text(ImVec2 corner, std::string_view words, float size, Tone tone,
            ImFont* font = nullptr) const;
  // text() that ends with "…" if it is wider.
  void short_text(ImVec2 corner, std::string words, float size, Tone tone, float max_width) const;
  void panel(const PixelBox& box, Tone tone) const;
  void frame(const PixelBox& box, ImU32 colour, float weight) const;
};

// A part of the box in its own shares, from 0 to 1.
[[nodiscard]] PixelBox part_of(const PixelBox& box, ImVec2 from, ImVec2 to);
// Whole pixels, so that areas that touch leave no seam.
[[nodiscard]] PixelBox in_whole_pixels(const PixelBox& box);

}  // namespace hapticwall::draw
