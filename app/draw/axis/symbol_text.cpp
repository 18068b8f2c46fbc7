#include "app/draw/axis/symbol_text.h"

#include <string>
#include <utility>
#include <vector>

namespace hapticwall::draw {
namespace {

constexpr float kSubscriptFontSize = 12.1F;  // 6.5 pt on paper, where kSmallFontSize is 7 pt
constexpr float kSubscriptFallEms = 0.2F;    // below the line of the text

bool is_word(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
         (letter >= '0' && letter <= '9');
}

// True at the underscore of "F_d", but not at that of a key, such as "mass_kg".
bool begins_subscript(std::string_view text, std::size_t at) {
  if (text[at] != '_' || at == 0 || at + 1 >= text.size()) return false;
  const bool one_letter = is_word(text[at - 1]) && (at == 1 || !is_word(text[at - 2]));
  return one_letter && is_word(text[at + 1]);
}

// Calls visit(part, is_subscript) for the parts from left to right.
template <typename Visit>
void visit_parts(std::string_view text, const Visit& visit) {
  std::size_t from = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (!begins_subscript(text, at)) continue;
    visit(text.substr(from, at - from), false);
    std::size_t end = at + 1;
    while (end < text.size() && is_word(text[end])) ++end;
    visit(text.substr(at + 1, end - at - 1), true);
    from = end;
  }
  if (from < text.size()) visit(text.substr(from), false);
}

float width_of(std::string_view part, bool is_subscript) {
  ImGui::PushFont(nullptr, is_subscript ? kSubscriptFontSize : 0.0F);
  const float width = ImGui::CalcTextSize(part.data(), part.data() + part.size()).x;
  ImGui::PopFont();
  return width;
}

// The lines of a text, as they fill.
class TextLines {
 public:
  explicit TextLines(float width) : width_(width) {}

  // Adds a piece to the line, or begins a line with it.
  void add(std::string_view piece, std::string_view separator) {
    const std::string longer =
        line_.empty() ? std::string(piece) : line_ + std::string(separator).append(piece);
    if (line_.empty() || symbol_text_size(longer).x <= width_) {
      line_ = longer;
    } else {
      lines_.push_back(std::exchange(line_, std::string(piece)));
    }
  }
  [[nodiscard]] bool fits(std::string_view piece) const {
    return symbol_text_size(piece).x <= width_;
  }
  [[nodiscard]] std::vector<std::string> finish() {
    if (!line_.empty()) lines_.push_back(std::move(line_));
    return std::move(lines_);
  }

 private:
  float width_;
  std::string line_;
  std::vector<std::string> lines_;
};

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> pieces;
  for (;;) {
    const std::size_t end = text.find(separator);
    pieces.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return pieces;
    text.remove_prefix(end + separator.size());
  }
}

// Words of a part; a number and the word behind it are one.
std::vector<std::string> words_of(std::string_view part) {
  std::vector<std::string> words;
  bool number = false;
  for (const std::string_view word : split(part, " ")) {
    if (number) {
      words.back().append(" ").append(word);
    } else {
      words.emplace_back(word);
    }
    number = !number && !word.empty() && word.back() >= '0' && word.back() <= '9';
  }
  return words;
}

}  // namespace

ImVec2 symbol_text_size(std::string_view text) {
  ImVec2 size(0.0F, ImGui::GetFontSize());
  visit_parts(text, [&](std::string_view part, bool is_subscript) {
    size.x += width_of(part, is_subscript);
  });
  return size;
}

void add_symbol_text(ImDrawList& list, ImVec2 corner, ImU32 colour, std::string_view text) {
  const float line = ImGui::GetFontSize();
  visit_parts(text, [&](std::string_view part, bool is_subscript) {
    const float width = width_of(part, is_subscript);
    ImGui::PushFont(nullptr, is_subscript ? kSubscriptFontSize : 0.0F);
    const float fall = is_subscript ? line - ImGui::GetFontSize() + kSubscriptFallEms * line : 0.0F;
    list.AddText(ImVec2(corner.x, corner.y + fall), colour, part.data(), part.data() + part.size());
    ImGui::PopFont();
    corner.x += width;
  });
}

// Dear ImGui leaves out glyphs beyond the clip, so the text is written at its corner and then
// turned.
void add_upright_text(ImDrawList& list, ImVec2 corner, ImU32 colour, std::string_view text) {
  const ImVec2 from = list.GetClipRectMin();
  const int first = list.VtxBuffer.Size;
  add_symbol_text(list, from, colour, text);
  for (int i = first; i < list.VtxBuffer.Size; ++i) {
    ImVec2& place = list.VtxBuffer[i].pos;
    place = ImVec2(corner.x + place.y - from.y, corner.y - (place.x - from.x));
  }
}

void symbol_text(ImU32 colour, std::string_view text) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  add_symbol_text(*ImGui::GetWindowDrawList(), corner, colour, text);
  ImGui::Dummy(symbol_text_size(text));
}

void wrapped_symbol_text(ImU32 colour, std::string_view text) {
  constexpr std::string_view kSeparator = "  ·  ";
  TextLines lines(ImGui::GetContentRegionAvail().x);
  for (const std::string_view part : split(text, kSeparator)) {
    if (lines.fits(part)) {
      lines.add(part, kSeparator);
      continue;
    }
    std::string_view separator = kSeparator;
    for (const std::string& word : words_of(part)) {
      lines.add(word, separator);
      separator = " ";
    }
  }
  ImGui::PushStyleVarY(ImGuiStyleVar_ItemSpacing, 0.0F);
  for (const std::string& line : lines.finish()) symbol_text(colour, line);
  ImGui::PopStyleVar();
  ImGui::Dummy(ImVec2());
}

}  // namespace hapticwall::draw
