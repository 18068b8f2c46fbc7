// The seal of a sidecar: a line with the SHA-256 of all other lines.
#pragma once

#include <string>
#include <string_view>

namespace hapticwall::file {

// The text with its seal. Precondition: it has a line "[recording]".
[[nodiscard]] std::string sealed(std::string text);

// True if the text was changed since it was sealed. False without a seal: older sidecars have none.
[[nodiscard]] bool is_broken_seal(std::string_view text);

}  // namespace hapticwall::file
