// A picture in memory, and PNG files.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"

namespace hapticwall::file {

// Shapes that are drawn in the place of pixels (app/draw/figure/shapes.h).
struct Shapes;

// A part of a vector file, `left` pixels from its left edge.
struct PlacedShapes {
  std::shared_ptr<const Shapes> shapes;
  int left = 0;
};

// 8-bit RGBA, rows from top to bottom, no padding; or shapes and no pixels.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
  std::vector<PlacedShapes> shapes{};
};

// Two pictures side by side; the space below a lower one is white. Realtime-safe: no.
[[nodiscard]] Picture beside(const Picture& left, const Picture& right);

// The bytes of a PNG file. Realtime-safe: no.
[[nodiscard]] Result<std::string> encode_png(const Picture& picture);

// Writes the picture to a temporary file and renames it at the end.
Failure write_png(const std::string& path, const Picture& picture);

}  // namespace hapticwall::file
