#include "app/draw/figure/column_name.h"

namespace hapticwall::draw {
namespace {

bool fits(const std::string& text, float width) {
  return ImGui::CalcTextSize(text.c_str()).x <= width;
}

// Without its last character, all bytes of it.
void drop_last(std::string& text) {
  constexpr unsigned kContinuation = 0x80;  // of UTF-8: 10xxxxxx
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == kContinuation)
    text.pop_back();
  if (!text.empty()) text.pop_back();
}

}  // namespace

void draw_column_name(const Theme& theme, const std::string& name, float width) {
  const FontScope strong(theme.fonts.strong, kFontSize);
  const FontScope font(nullptr, fits(name, width) ? kFontSize : kSmallFontSize);
  std::string shown = name;
  for (std::string kept = name; !kept.empty() && !fits(shown, width);) {
    drop_last(kept);
    shown = kept + "…";
  }
  ImGui::TextUnformatted(shown.c_str());
}

}  // namespace hapticwall::draw
