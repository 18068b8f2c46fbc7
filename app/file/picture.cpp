#include "app/file/picture.h"

#include <algorithm>
#include <cstdint>

namespace hapticwall::file {

namespace {

constexpr std::size_t kBytesPerPixel = 4;

// Puts `part` into `whole`, which has room for it, with this upper left corner.
void put(Picture& whole, const Picture& part, int left, int top) {
  for (const PlacedShapes& each : part.shapes)
    whole.shapes.push_back({each.shapes, left + each.left, top + each.top});
  if (whole.rgba.empty()) return;
  const std::size_t length = static_cast<std::size_t>(part.width) * kBytesPerPixel;
  for (int y = 0; y < part.height; ++y) {
    const auto from = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * length);
    const std::size_t to =
        static_cast<std::size_t>(top + y) * static_cast<std::size_t>(whole.width) +
        static_cast<std::size_t>(left);
    std::copy_n(part.rgba.begin() + from, length,
                whole.rgba.begin() + static_cast<std::ptrdiff_t>(to * kBytesPerPixel));
  }
}

// `second` at (left, top) of a page of this size.
Picture joined(const Picture& first, const Picture& second, int left, int top) {
  constexpr std::uint8_t kWhite = 255;
  Picture both;
  both.width = std::max(first.width, left + second.width);
  both.height = std::max(first.height, top + second.height);
  both.pixels_per_metre = first.pixels_per_metre;
  if (first.shapes.empty()) {
    both.rgba.assign(static_cast<std::size_t>(both.width) * static_cast<std::size_t>(both.height) *
                         kBytesPerPixel,
                     kWhite);
  }
  put(both, first, 0, 0);
  put(both, second, left, top);
  return both;
}

}  // namespace

Picture beside(const Picture& left, const Picture& right) {
  return joined(left, right, left.width, 0);
}

Picture below(const Picture& upper, const Picture& lower) {
  return joined(upper, lower, 0, upper.height);
}

}  // namespace hapticwall::file
