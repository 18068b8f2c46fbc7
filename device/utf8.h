// Text as the operating system's wide characters give it, for the rest of the program.
#pragma once

#include <string>

namespace hapticwall::device {

// UTF-8; what is no character, or a control one (a device names itself, and may name itself with a
// terminal's commands), becomes U+FFFD. nullptr gives nothing. Realtime-safe: no.
[[nodiscard]] std::string to_utf8(const wchar_t* text);

}  // namespace hapticwall::device
