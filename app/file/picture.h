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

// A part of a vector file, in pixels from its upper left corner.
struct PlacedShapes {
  std::shared_ptr<const Shapes> shapes;
  int left = 0;
  int top = 0;
};

// 8-bit RGBA, rows from top to bottom, no padding; or shapes and no pixels.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
  std::vector<PlacedShapes> shapes{};
  int pixels_per_metre = 0;  // of a printed picture; 0: none
};

// Two pictures side by side, or one below the other; the space beside the smaller one is white.
// Realtime-safe: no.
[[nodiscard]] Picture beside(const Picture& left, const Picture& right);
[[nodiscard]] Picture below(const Picture& upper, const Picture& lower);

// The bytes of a PNG file. Realtime-safe: no.
[[nodiscard]] Result<std::string> encode_png(const Picture& picture);

// Writes the picture to a temporary file and renames it at the end.
Failure write_png(const std::string& path, const Picture& picture);

}  // namespace hapticwall::file
