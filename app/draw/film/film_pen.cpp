#include "app/draw/film/film_pen.h"

#include <cfloat>
#include <cmath>

namespace hapticwall::draw {
namespace {

constexpr float kPanelRounding = 8.0F;  // pixels at scale 1

}  // namespace

float FilmPen::width(std::string_view words, float size, ImFont* font) const {
  ImFont* used = font != nullptr ? font : theme.fonts.text;
  return used->CalcTextSizeA(scale * size, FLT_MAX, 0.0F, words.data(), words.data() + words.size())
      .x;
}

void FilmPen::text(ImVec2 corner, std::string_view words, float size, Tone tone,
                   ImFont* font) const {
  list->AddText(font != nullptr ? font : theme.fonts.text, scale * size, corner, theme.packed(tone),
                words.data(), words.data() + words.size());
}

void FilmPen::short_text(ImVec2 corner, std::string words, float size, Tone tone,
                         float max_width) const {
  constexpr const char* kEllipsis = "…";
  const auto is_inside = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  std::string shown = words;
  while (!words.empty() && width(shown, size, nullptr) > max_width) {
    while (!words.empty() && is_inside(words.back())) words.pop_back();
    if (!words.empty()) words.pop_back();
    shown = words + kEllipsis;
  }
  text(corner, shown, size, tone);
}

void FilmPen::panel(const PixelBox& box, Tone tone) const {
  list->AddRectFilled(box.from, box.to, theme.packed(tone), kPanelRounding * scale);
}

void FilmPen::frame(const PixelBox& box, ImU32 colour, float weight) const {
  list->AddRect(box.from, box.to, colour, kPanelRounding * scale, 0, weight * scale);
}

PixelBox part_of(const PixelBox& box, ImVec2 from, ImVec2 to) {
  const ImVec2 size(box.to.x - box.from.x, box.to.y - box.from.y);
  return {{box.from.x + from.x * size.x, box.from.y + from.y * size.y},
          {box.from.x + to.x * size.x, box.from.y + to.y * size.y}};
}

PixelBox in_whole_pixels(const PixelBox& box) {
  return {{std::round(box.from.x), std::round(box.from.y)},
          {std::round(box.to.x), std::round(box.to.y)}};
}

}  // namespace hapticwall::draw
