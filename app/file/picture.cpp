#include "app/file/picture.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cstring>

#include "app/file/disk/atomic_file.h"

namespace hapticwall::file {

Picture beside(const Picture& left, const Picture& right) {
  constexpr std::size_t kBytesPerPixel = 4;
  constexpr std::uint8_t kWhite = 255;
  Picture both{left.width + right.width, std::max(left.height, right.height), {}, left.shapes};
  for (const PlacedShapes& part : right.shapes)
    both.shapes.push_back({part.shapes, left.width + part.left});
  if (!both.shapes.empty()) return both;
  const std::size_t row = static_cast<std::size_t>(both.width) * kBytesPerPixel;
  both.rgba.assign(row * static_cast<std::size_t>(both.height), kWhite);
  const auto copy = [&](const Picture& from, std::size_t offset) {
    const std::size_t length = static_cast<std::size_t>(from.width) * kBytesPerPixel;
    for (std::size_t y = 0; y < static_cast<std::size_t>(from.height); ++y) {
      std::copy_n(from.rgba.begin() + static_cast<std::ptrdiff_t>(y * length), length,
                  both.rgba.begin() + static_cast<std::ptrdiff_t>(y * row + offset));
    }
  };
  copy(left, 0);
  copy(right, static_cast<std::size_t>(left.width) * kBytesPerPixel);
  return both;
}

Result<std::string> encode_png(const Picture& picture) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.format = PNG_FORMAT_RGBA;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  const std::size_t expected_bytes = PNG_IMAGE_SIZE(image);
  if (picture.width <= 0 || picture.height <= 0 || picture.rgba.size() != expected_bytes) {
    return file_error(fmt::format("a picture of {} x {} pixels cannot have {} bytes", picture.width,
                                  picture.height, picture.rgba.size()));
  }
  std::string bytes;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  bytes.resize(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgba.data(), 0, nullptr) ==
      0) {
    return file_error(
        fmt::format("the picture cannot be encoded: {}", std::string_view(image.message)));
  }
  bytes.resize(size);
  return bytes;
}

Failure write_png(const std::string& path, const Picture& picture) {
  const Result<std::string> bytes = encode_png(picture);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes);
}

}  // namespace hapticwall::file
