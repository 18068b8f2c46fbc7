// Shared libraries with an algorithm or a device of the user.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/result.h"

namespace hapticwall::file {

struct LibraryBytes {
  std::string path;
  std::string bytes;
  std::string sha256;
};

// Fails for what is no file, and for a file that another user than this one and root can write, or
// that is in a folder where another user can put one: its code would run with the rights of this
// user. Realtime-safe: no.
[[nodiscard]] Result<LibraryBytes> read_library(const std::string& path);

// Why the program cannot take what `symbol` points to, or "".
using ProblemOf = std::function<std::string(const void* symbol)>;

// Loads a copy in memory, for ever, and finds what it exports as `symbol`. Fails (exit status 2)
// for a file that is no library or not whole, and where `problem_of` has a reason. Runs code of the
// library. Realtime-safe: no.
[[nodiscard]] Result<const void*> load_library(const LibraryBytes& file, const char* symbol,
                                               const ProblemOf& problem_of);

[[nodiscard]] Error not_a_plugin(const std::string& path, std::string_view problem);

}  // namespace hapticwall::file
