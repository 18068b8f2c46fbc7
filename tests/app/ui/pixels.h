// Colours of pixels in pictures.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "app/file/picture.h"

namespace hapticwall::test {

struct Colour {
  int red = 0;
  int green = 0;
  int blue = 0;
};

inline Colour colour_of(const ImVec4& value) {
  const auto byte = [](float share) { return static_cast<int>(std::lround(share * 255.0F)); };
  return {byte(value.x), byte(value.y), byte(value.z)};
}

inline Colour pixel(const file::Picture& picture, int x, int y) {
  const std::size_t start =
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
           static_cast<std::size_t>(x));
  return {picture.rgba[start], picture.rgba[start + 1], picture.rgba[start + 2]};
}

inline int difference(Colour a, Colour b) {
  return std::max(
      {std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

inline int brightness(Colour a) { return (a.red + a.green + a.blue) / 3; }

// Number of pixels of this colour in the rectangle, within `tolerance`.
inline int count_pixels(const file::Picture& picture, Colour wanted, int from_x, int from_y,
                        int to_x, int to_y, int tolerance = 24) {
  int count = 0;
  for (int y = from_y; y < to_y; ++y) {
    for (int x = from_x; x < to_x; ++x) {
      if (difference(pixel(picture, x, y), wanted) <= tolerance) ++count;
    }
  }
  return count;
}

// The edge of a letter may differ by its place in the atlas; a letter on two buttons has two edges
// of 14 pixels. A changed digit has more pixels.
inline constexpr int kGlyphEdge = 28;

inline int pixels_that_differ(const file::Picture& a, const file::Picture& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4)
    count += std::equal(a.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                        a.rgba.begin() + static_cast<std::ptrdiff_t>(i + 4),
                        b.rgba.begin() + static_cast<std::ptrdiff_t>(i))
                 ? 0
                 : 1;
  return count;
}

}  // namespace hapticwall::test
