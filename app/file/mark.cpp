#include "app/file/mark.h"

#include "app/file/text.h"

namespace hapticwall::file {

// shown() ends with the character that reaches its limit, of up to 4 bytes, and three dots.
std::string mark_text(std::string_view typed) {
  constexpr std::size_t kEndBytes = 3 + 3;
  return shown(typed, kLongestMarkBytes - kEndBytes);
}

}  // namespace hapticwall::file
