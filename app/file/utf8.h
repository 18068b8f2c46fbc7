// UTF-8 from elsewhere: what of it is well-formed. No surrogates, nothing beyond U+10FFFF, nothing
// longer than need be.
#pragma once

#include <cstddef>
#include <string_view>

namespace hapticwall::file {

// Length in bytes of the well-formed sequence that `text` starts with; 0 where there is none.
// Precondition: not empty.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

// Whether all of it is well-formed.
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace hapticwall::file
