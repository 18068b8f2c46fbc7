// A picture as the bytes of a PNG file.
#include <fmt/format.h>
#include <png.h>

#include <cstdint>
#include <cstring>
#include <string_view>

#include "app/file/disk/atomic_file.h"
#include "app/file/picture.h"

namespace hapticwall::file {
namespace {

// A number of a PNG, the highest byte first.
std::string png_number(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    bytes.push_back(static_cast<char>(value >> shift & 0xFFU));
  return bytes;
}

// A chunk of a PNG: length, type, content and CRC (PNG specification, third edition, 5.3).
std::string png_chunk(std::string_view type, std::string_view content) {
  std::uint32_t crc = 0xFFFFFFFFU;
  const std::string checked = std::string(type).append(content);
  for (const char each : checked) {
    crc ^= static_cast<unsigned char>(each);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
  }
  return png_number(static_cast<std::uint32_t>(content.size())) + checked + png_number(~crc);
}

// The chunk pHYs: the printed size of a pixel. It stands behind the header.
void add_resolution(std::string& png, int pixels_per_metre) {
  constexpr std::size_t kSignatureAndHeader = 8 + 25;
  constexpr char kPerMetre = 1;
  const std::string side = png_number(static_cast<std::uint32_t>(pixels_per_metre));
  const std::string content = side + side + kPerMetre;
  png.insert(kSignatureAndHeader, png_chunk("pHYs", content));
}

}  // namespace

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
  if (picture.pixels_per_metre > 0) add_resolution(bytes, picture.pixels_per_metre);
  return bytes;
}

Failure write_png(const std::string& path, const Picture& picture) {
  const Result<std::string> bytes = encode_png(picture);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes);
}

}  // namespace hapticwall::file
