#include "app/draw/axis/axis_titles.h"

#include <algorithm>
#include <array>

#include "app/draw/axis/symbol_text.h"

namespace hapticwall::draw {
namespace {

constexpr float kTitleLineEms = 1.1F;
constexpr float kTitleGapEms = 0.3F;  // from the title to the labels

// The title in two lines: the second one is "symbol (unit)" or the unit, whichever is shorter.
std::array<std::string, 2> lines_of(const std::string& title) {
  const std::size_t unit = title.rfind(" (");
  if (unit == std::string::npos || unit == 0) return {title, ""};
  const std::size_t symbol = title.rfind(' ', unit - 1);
  if (symbol == std::string::npos) return {title.substr(0, unit), title.substr(unit + 1)};
  const std::string last = title.substr(symbol + 1);
  const float with_symbol =
      std::max(symbol_text_size(title.substr(0, symbol)).x, symbol_text_size(last).x);
  const float without = std::max(symbol_text_size(title.substr(0, unit)).x,
                                 symbol_text_size(title.substr(unit + 1)).x);
  const std::size_t cut = with_symbol <= without ? symbol : unit;
  return {title.substr(0, cut), title.substr(cut + 1)};
}

}  // namespace

float title_room(const std::string& title, float height) {
  const float lines = symbol_text_size(title).x <= height ? 1.0F : 2.0F;
  return (lines * kTitleLineEms + kTitleGapEms) * ImGui::GetFontSize();
}

void draw_upright_title(ImU32 colour, const std::string& title, float left, float room, float top,
                        float height) {
  const float line = kTitleLineEms * ImGui::GetFontSize();
  const float gap = kTitleGapEms * ImGui::GetFontSize();
  const bool is_one = room - gap < 1.5F * line || symbol_text_size(title).x <= height;
  if (is_one) left += room - gap - line;  // beside the labels
  const std::array<std::string, 2> lines =
      is_one ? std::array<std::string, 2>{title, ""} : lines_of(title);
  for (const std::string& text : lines) {
    const float length = symbol_text_size(text).x;
    add_upright_text(*ImGui::GetWindowDrawList(), {left, top + 0.5F * (height + length)}, colour,
                     text);
    left += line;
  }
}

void draw_title_below(ImU32 colour, const std::string& title, float left, float width) {
  const float top = ImGui::GetCursorScreenPos().y;
  ImGui::SetCursorScreenPos({left + 0.5F * (width - symbol_text_size(title).x), top});
  symbol_text(colour, title);
}

}  // namespace hapticwall::draw
