// Text files that people write: read whole, and refused where they are too large to be one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/result.h"

namespace hapticwall::file {

// The whole file. `kind` names in messages what it should have been ("scene"). An empty file is
// refused too.
[[nodiscard]] Result<std::string> read_small_file(const std::string& path, std::string_view kind,
                                                  std::size_t largest_bytes);

}  // namespace hapticwall::file
