// Promises of every text that a person sees.
#pragma once

#include <string_view>

#include "core/result.h"

namespace hapticwall::fuzz {

// Well-formed UTF-8 without control characters, those of U+0080 to U+009F included: a terminal
// takes some of them for commands.
[[nodiscard]] bool is_clean(std::string_view text);

// An error of the user's: one clean line that begins with the place where the mistake is, of a
// length that somebody reads. Throws BrokenPromise.
void require_one_clean_line(const Error& error, std::string_view place);

}  // namespace hapticwall::fuzz
