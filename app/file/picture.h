// A picture in memory, and PNG files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace hapticwall::file {

// 8-bit RGBA, rows from top to bottom, no padding.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
};

// Two pictures side by side; the space below a lower one is white. Realtime-safe: no.
[[nodiscard]] Picture beside(const Picture& left, const Picture& right);

// The bytes of a PNG file. Realtime-safe: no.
[[nodiscard]] Result<std::string> encode_png(const Picture& picture);

// Writes the picture to a temporary file and renames it at the end.
Failure write_png(const std::string& path, const Picture& picture);

}  // namespace hapticwall::file
