// Text from outside and for files: UTF-8, control characters, fields of CSV.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapticwall {

// Bytes of the well-formed sequence at the start of `text`; 0 if there is none. Surrogates,
// overlong forms and everything beyond U+10FFFF are malformed. Precondition: not empty.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

// True if the well-formed sequence at the start of `text` is a control character: U+0000 to U+001F,
// U+007F to U+009F. Precondition: not empty.
[[nodiscard]] bool starts_with_control(std::string_view text);

[[nodiscard]] bool is_utf8(std::string_view text);

// Replaces invalid and control characters by U+FFFD: a device chooses its own name, which could
// hold a terminal's commands. nullptr gives an empty text.
[[nodiscard]] std::string to_utf8(const wchar_t* text);

// A field of CSV as in RFC 4180, quoted if necessary.
[[nodiscard]] std::string csv_field(std::string_view text);
// The fields of a line of CSV without its end; nullopt if its quotes do not match. A field with a
// line break cannot be read.
[[nodiscard]] std::optional<std::vector<std::string>> csv_fields(std::string_view line);

}  // namespace hapticwall
