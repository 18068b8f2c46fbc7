#include "tests/fuzz/text_promises.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/target.h"

namespace hapticwall::fuzz {
namespace {

// Longer than the longest list of known keys that a message gives.
constexpr std::size_t kMaxMessageBytes = 2000;

struct Form {
  std::uint8_t lead_mask;
  std::uint8_t lead;
  std::size_t length;
  std::uint32_t least;  // fewer bytes would do for anything below
};
constexpr std::array kForms{Form{0x80, 0x00, 1, 0x0}, Form{0xE0, 0xC0, 2, 0x80},
                            Form{0xF0, 0xE0, 3, 0x800}, Form{0xF8, 0xF0, 4, 0x10000}};
constexpr std::uint32_t kNone = 0xFFFFFFFF;

// The first character, which is taken off; kNone where it is not well formed.
std::uint32_t take_character(std::string_view& text) {
  constexpr std::uint32_t kContinuation = 0x80;
  constexpr std::uint32_t kContinuationMask = 0xC0;
  constexpr unsigned kContinuationBits = 6;
  const auto lead = static_cast<std::uint8_t>(text.front());
  for (const Form& form : kForms) {
    if ((lead & form.lead_mask) != form.lead || form.length > text.size()) continue;
    std::uint32_t character = lead & static_cast<std::uint8_t>(~form.lead_mask);
    for (const char next : text.substr(1, form.length - 1)) {
      const std::uint32_t byte = static_cast<std::uint8_t>(next);
      if ((byte & kContinuationMask) != kContinuation) return kNone;
      character = character << kContinuationBits | (byte & ~kContinuationMask);
    }
    text.remove_prefix(form.length);
    return character < form.least ? kNone : character;
  }
  return kNone;
}

bool is_control(std::uint32_t character) {
  return character < 0x20 || (character >= 0x7F && character < 0xA0);
}

bool is_no_character(std::uint32_t character) {
  const bool surrogate = character >= 0xD800 && character < 0xE000;
  return surrogate || character > 0x10FFFF;
}

}  // namespace

bool is_clean(std::string_view text) {
  while (!text.empty()) {
    const std::uint32_t character = take_character(text);
    if (is_no_character(character) || is_control(character)) return false;
  }
  return true;
}

void require_one_clean_line(const Error& error, std::string_view place) {
  const std::string& message = error.message;
  require(error.kind == ErrorKind::kUsage, "a mistake in a text is a usage error");
  require(is_clean(message), "a message is one clean line");
  require(message.starts_with(place), "a message begins with where the mistake is");
  require(message.size() > place.size(), "a message says what is wrong");
  require(message.size() <= kMaxMessageBytes, "a message is short enough to be read");
}

}  // namespace hapticwall::fuzz
