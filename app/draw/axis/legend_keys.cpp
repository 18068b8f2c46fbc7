#include "app/draw/axis/legend_keys.h"

#include "app/draw/axis/symbol_text.h"

namespace hapticwall::draw {

void begin_key(float width) {
  const bool first = ImGui::GetCursorPosX() <= ImGui::GetCursorStartPos().x;
  if (!first && ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

void draw_key_text(ImU32 colour, std::string_view text, float gap) {
  if (symbol_text_size(text).x <= ImGui::GetContentRegionAvail().x) {
    symbol_text(colour, text);
  } else {
    wrapped_symbol_text(colour, text);
  }
  ImGui::SameLine(0.0F, gap);
}

}  // namespace hapticwall::draw
