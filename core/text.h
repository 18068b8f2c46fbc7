// UTF-8: checks text from files and arguments, and converts the operating system's wide text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hapticwall {

// Bytes of the well-formed sequence at the start of `text`; 0 if there is none. Surrogates,
// overlong forms and everything beyond U+10FFFF are malformed. Precondition: not empty.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

[[nodiscard]] bool is_utf8(std::string_view text);

// Replaces invalid and control characters by U+FFFD: a device chooses its own name, which could
// hold a terminal's commands. nullptr gives an empty text.
[[nodiscard]] std::string to_utf8(const wchar_t* text);

}  // namespace hapticwall
