// Text in messages, SHA-256, PNG.
#include "app/file/text/text.h"

#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "app/file/disk/sha256.h"
#include "app/file/picture.h"

namespace hapticwall::file {
namespace {

TEST(Text, QuotesAreCutAndCleaned) {
  EXPECT_EQ(in_quotes("plain"), "'plain'");
  EXPECT_EQ(in_quotes("a\nb\tc\x1b[31m\x7f"), "'a?b?c?[31m?'");
  EXPECT_EQ(in_quotes("µ \xff \xc3"), "'µ ? ?'");
  EXPECT_EQ(in_quotes("\xc2\x9b"), "'?'");  // CSI, a control character of eight bits
  EXPECT_EQ(in_quotes(std::string(200, 'x')), "'" + std::string(kMaxQuoteBytes, 'x') + "...'");
}

TEST(Text, NearestName) {
  constexpr std::array<std::string_view, 4> kNames{"press", "tap", "stiffness_n_per_m",
                                                   "friction_n"};
  EXPECT_EQ(nearest_name("pres", kNames), "press");
  EXPECT_EQ(nearest_name("rpess", kNames), "press");
  EXPECT_EQ(nearest_name("stifness", kNames), "stiffness_n_per_m");
  EXPECT_EQ(nearest_name("stiff", kNames), "stiffness_n_per_m");
  EXPECT_EQ(nearest_name("friction", kNames), "friction_n");
  EXPECT_FALSE(nearest_name("gravity", kNames));
  EXPECT_FALSE(nearest_name("", kNames));
  EXPECT_FALSE(nearest_name(std::string(100'000, 'p'), kNames));
}

TEST(Text, NumbersReadBackTheSame) {
  for (const double value : {0.1, 1.0 / 3.0, 6.0, -0.0, 1e22, 5e-324, 1.7976931348623157e308,
                             0.254e-3, 123456789012345678.0}) {
    const std::string text = shortest_number(value);
    double read = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    EXPECT_EQ(read, value) << shortest_number(value);
    EXPECT_EQ(std::signbit(read), std::signbit(value));
  }
  EXPECT_EQ(shortest_number(0.1), "0.1");
}

// FIPS 180-4, examples.
TEST(Sha256, KnownDigests) {
  EXPECT_EQ(Sha256().finish(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  Sha256 digest;
  digest.update("a");
  digest.update("bc");
  EXPECT_EQ(digest.finish(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Png, RowsAreFromTopToBottom) {
  Picture picture;
  picture.width = 2;
  picture.height = 3;
  for (std::uint8_t i = 0; i < 2 * 3; ++i) {
    picture.rgba.insert(picture.rgba.end(), {static_cast<std::uint8_t>(10 * i), 1, 2, 255});
  }
  const Result<std::string> bytes = encode_png(picture);
  ASSERT_TRUE(bytes) << bytes.error().message;

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&image, bytes->data(), bytes->size()), 0);
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr), 0);
  EXPECT_EQ(image.width, 2U);
  EXPECT_EQ(image.height, 3U);
  EXPECT_EQ(read, picture.rgba);
}

TEST(Png, RefusesAPictureOfTheWrongSize) {
  EXPECT_FALSE(encode_png({}));
  EXPECT_FALSE(encode_png({2, 2, std::vector<std::uint8_t>(15)}));
}

}  // namespace
}  // namespace hapticwall::file
