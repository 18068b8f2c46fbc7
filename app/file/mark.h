// What somebody noted while a recording ran: a place in it, and a few words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hapticwall::file {

// With these a sidecar stays well within what is read of one.
inline constexpr std::size_t kMostMarks = 1000;        // of a recording
inline constexpr std::size_t kLongestMarkBytes = 200;  // of a text, UTF-8

struct Mark {
  std::uint64_t tick = 0;
  std::string text;  // may be empty

  friend bool operator==(const Mark&, const Mark&) = default;
};

// What somebody typed as the text of a mark: without control characters and broken UTF-8, and not
// longer than it may be.
[[nodiscard]] std::string mark_text(std::string_view typed);

}  // namespace hapticwall::file
