// Reads small text files, and refuses large ones.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/result.h"

namespace hapticwall::file {

// The whole file. `kind` names the expected content in messages ("scene"). Refuses an empty file.
[[nodiscard]] Result<std::string> read_small_file(const std::string& path, std::string_view kind,
                                                  std::size_t max_bytes);

}  // namespace hapticwall::file
