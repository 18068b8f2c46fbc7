#include "app/file/picture.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdint>
#include <string>

namespace hapticwall::file {
namespace {

Picture filled(int width, int height, std::uint8_t value, int pixels_per_metre = 0) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.rgba.assign(static_cast<std::size_t>(4 * width * height), value);
  picture.pixels_per_metre = pixels_per_metre;
  return picture;
}

std::uint8_t red(const Picture& picture, int x, int y) {
  return picture.rgba[static_cast<std::size_t>(4 * (y * picture.width + x))];
}

// Reads with the functions of libpng that check every chunk.
struct Resolution {
  png_uint_32 across = 0;
  png_uint_32 down = 0;
  int unit = -1;
};
Resolution resolution_of(const std::string& bytes) {
  Resolution found;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const char* next = bytes.data();
  if (setjmp(png_jmpbuf(png)) == 0) {
    png_set_read_fn(png, static_cast<void*>(&next), [](png_structp from, png_bytep to, size_t n) {
      auto& place = *static_cast<const char**>(png_get_io_ptr(from));
      std::copy_n(place, n, to);
      place += n;
    });
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    png_get_pHYs(png, info, &found.across, &found.down, &found.unit);
  } else {
    ADD_FAILURE() << "libpng refuses it";
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return found;
}

TEST(Picture, APngOfAFigureHasItsPrintedSize) {
  const auto printed = encode_png(filled(20, 10, 100, 11811));
  ASSERT_TRUE(printed.ok());
  const Resolution found = resolution_of(*printed);
  EXPECT_EQ(found.across, 11811U);
  EXPECT_EQ(found.down, 11811U);
  EXPECT_EQ(found.unit, PNG_RESOLUTION_METER);
}

TEST(Picture, APngOfAScreenHasNone) {
  const auto screen = encode_png(filled(20, 10, 100));
  ASSERT_TRUE(screen.ok());
  EXPECT_EQ(resolution_of(*screen).unit, -1);
}

TEST(Picture, TwoOfThemStandBesideEachOtherOnWhite) {
  const Picture both = beside(filled(3, 2, 10, 7), filled(2, 4, 20, 7));
  EXPECT_EQ(both.width, 5);
  EXPECT_EQ(both.height, 4);
  EXPECT_EQ(both.pixels_per_metre, 7);
  EXPECT_EQ(red(both, 2, 1), 10);
  EXPECT_EQ(red(both, 3, 3), 20);
  EXPECT_EQ(red(both, 2, 2), 255);
}

TEST(Picture, TwoOfThemStandBelowEachOtherOnWhite) {
  const Picture both = below(filled(3, 2, 10), filled(2, 4, 20));
  EXPECT_EQ(both.width, 3);
  EXPECT_EQ(both.height, 6);
  EXPECT_EQ(red(both, 2, 1), 10);
  EXPECT_EQ(red(both, 1, 5), 20);
  EXPECT_EQ(red(both, 2, 2), 255);
}

}  // namespace
}  // namespace hapticwall::file
