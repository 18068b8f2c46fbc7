#include "core/text.h"

#include <array>
#include <cstdint>
#include <type_traits>

namespace hapticwall {
namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;
constexpr unsigned kTailBits = 6;  // bits that a continuation byte carries

bool may_be_shown(std::uint32_t character) {
  const bool control = character < 0x20 || (character >= 0x7F && character <= 0x9F);
  const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
  return !control && !surrogate && character <= 0x10FFFF;
}

void append(std::string& text, std::uint32_t character) {
  // Lead bytes by the number of continuation bytes.
  constexpr std::array<std::uint32_t, 4> kLeads{0x00, 0xC0, 0xE0, 0xF0};
  unsigned tails = character > 0xFFFF ? 3 : character > 0x7FF ? 2 : character > 0x7F ? 1 : 0;
  text += static_cast<char>(kLeads[tails] | (character >> (tails * kTailBits)));
  while (tails-- > 0) {
    text += static_cast<char>(0x80U | ((character >> (tails * kTailBits)) & 0x3FU));
  }
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  std::size_t length = 0;
  if (lead < 0x80) length = 1;
  if (lead >= 0xc2 && lead < 0xe0) length = 2;
  if (lead >= 0xe0 && lead < 0xf0) length = 3;
  if (lead >= 0xf0 && lead < 0xf5) length = 4;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xc0U) != 0x80U) return 0;
  }
  if (length < 3) return length;
  // The second byte reveals overlong forms, surrogates and code points beyond U+10FFFF.
  const auto second = static_cast<unsigned char>(text[1]);
  const bool overlong = (lead == 0xe0 && second < 0xa0) || (lead == 0xf0 && second < 0x90);
  const bool no_character = (lead == 0xed && second >= 0xa0) || (lead == 0xf4 && second >= 0x90);
  return overlong || no_character ? 0 : length;
}

bool starts_with_control(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  // U+0080 to U+009F are 0xc2 0x80 to 0xc2 0x9f.
  return first < 0x20 || first == 0x7F ||
         (first == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0);
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string to_utf8(const wchar_t* text) {
  std::string result;
  if (text == nullptr) return result;
  for (; *text != L'\0'; ++text) {
    // wchar_t may be signed; a negative value is not a character.
    const auto character =
        static_cast<std::uint32_t>(static_cast<std::make_unsigned_t<wchar_t>>(*text));
    append(result, may_be_shown(character) ? character : kReplacement);
  }
  return result;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::optional<std::vector<std::string>> csv_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  bool closed = false;  // after the last quote of a field only a comma may follow
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted) {
      const bool doubled = c == '"' && line.substr(i + 1).starts_with('"');
      quoted = c != '"' || doubled;
      closed = !quoted;
      if (quoted) fields.back() += c;
      if (doubled) ++i;
    } else if (c == ',') {
      fields.emplace_back();
      closed = false;
    } else if (closed || (c == '"' && !fields.back().empty())) {
      return std::nullopt;
    } else if (c == '"') {
      quoted = true;
    } else {
      fields.back() += c;
    }
  }
  return quoted ? std::nullopt : std::optional(std::move(fields));
}

}  // namespace hapticwall
