#include "device/utf8.h"

#include <cstdint>
#include <type_traits>

namespace hapticwall::device {
namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;
constexpr std::uint32_t kLastCharacter = 0x10FFFF;
constexpr std::uint32_t kFirstSurrogate = 0xD800;
constexpr std::uint32_t kLastSurrogate = 0xDFFF;
// The largest character of one, two and three bytes.
constexpr std::uint32_t kOneByte = 0x7F;
constexpr std::uint32_t kTwoBytes = 0x7FF;
constexpr std::uint32_t kThreeBytes = 0xFFFF;

// Controls: below a space, and from DEL to the end of the second row of them.
constexpr std::uint32_t kSpace = 0x20;
constexpr std::uint32_t kDelete = 0x7F;
constexpr std::uint32_t kLastControl = 0x9F;

constexpr unsigned kTailBits = 6;  // of a character in each byte but the first
constexpr std::uint32_t kTailMask = (1U << kTailBits) - 1;

bool may_be_shown(std::uint32_t character) {
  const bool control = character < kSpace || (character >= kDelete && character <= kLastControl);
  const bool surrogate = character >= kFirstSurrogate && character <= kLastSurrogate;
  return !control && !surrogate && character <= kLastCharacter;
}

void append(std::string& text, std::uint32_t character) {
  const auto first = [&](std::uint32_t mark, unsigned tails) {
    text += static_cast<char>(mark | (character >> (tails * kTailBits)));
    while (tails-- > 0) {
      text += static_cast<char>(0x80U | ((character >> (tails * kTailBits)) & kTailMask));
    }
  };
  if (character <= kOneByte) {
    first(0, 0);
  } else if (character <= kTwoBytes) {
    first(0xC0, 1);
  } else if (character <= kThreeBytes) {
    first(0xE0, 2);
  } else {
    first(0xF0, 3);
  }
}

}  // namespace

std::string to_utf8(const wchar_t* text) {
  std::string result;
  if (text == nullptr) return result;
  for (; *text != L'\0'; ++text) {
    // A negative one is none, whatever sign the type has.
    auto character = static_cast<std::uint32_t>(static_cast<std::make_unsigned_t<wchar_t>>(*text));
    if (!may_be_shown(character)) character = kReplacement;
    append(result, character);
  }
  return result;
}

}  // namespace hapticwall::device
