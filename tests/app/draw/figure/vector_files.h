// The files that a figure becomes, drawn by other programs.
#pragma once

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "app/draw/figure/figure_file.h"
#include "app/file/picture.h"

namespace hapticwall::test {

using DrawWith = std::function<Result<file::Picture>(draw::Ink ink)>;

inline file::Picture decode_png(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return {};
  image.format = PNG_FORMAT_RGBA;
  file::Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.rgba.resize(PNG_IMAGE_SIZE(image));
  png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr);
  return picture;
}

// The file of a figure, removed at the end.
class FigureFile {
 public:
  FigureFile(const DrawWith& draw, const std::string& ending)
      : path_(::testing::TempDir() + "hapticwall_figure" + std::to_string(getpid()) + ending) {
    const Result<file::Picture> figure = draw(draw::ink_of(path_));
    EXPECT_TRUE(figure.ok()) << (figure.ok() ? "" : figure.error().message);
    if (!figure.ok()) return;
    const Result<std::string> encoded = draw::encode_figure(*figure, path_);
    EXPECT_TRUE(encoded.ok()) << (encoded.ok() ? "" : encoded.error().message);
    if (encoded.ok()) bytes_ = *encoded;
    std::ofstream(path_, std::ios::binary) << bytes_;
  }
  FigureFile(const FigureFile&) = delete;
  FigureFile& operator=(const FigureFile&) = delete;
  ~FigureFile() {
    std::filesystem::remove(path_);
    std::filesystem::remove(path_ + ".out");
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  // Empty if it cannot be drawn.
  [[nodiscard]] file::Picture drawn() const {
    const bool pdf = bytes_.starts_with("%PDF");
    return decode_png(passed_through(pdf ? "f() { pdftocairo -png -singlefile -r 300 \"$1\" -; }; f"
                                         : "rsvg-convert -z 3.125"));
  }
  // Output of `command FILE`; empty if it fails.
  [[nodiscard]] std::string passed_through(const std::string& command) const {
    const std::string line = command + " '" + path_ + "' >'" + path_ + ".out'";
    if (std::system(line.c_str()) != 0) return {};
    std::ifstream file(path_ + ".out", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::string path_;
  std::string bytes_;
};

// Mean colour values of squares of 8 x 8 pixels, of the part with this size: edges may be smoothed
// in another way.
inline std::vector<double> coarse(const file::Picture& picture, int width, int height) {
  constexpr int kSide = 8;
  const int columns = width / kSide;
  std::vector<double> means(static_cast<std::size_t>(columns * (height / kSide) * 4));
  for (int y = 0; y < height / kSide * kSide; ++y) {
    const std::size_t row =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) * 4;
    for (int i = 0; i < columns * kSide * 4; ++i) {
      const int square = (y / kSide * columns + i / 4 / kSide) * 4 + i % 4;
      means[static_cast<std::size_t>(square)] +=
          picture.rgba[row + static_cast<std::size_t>(i)] / static_cast<double>(kSide * kSide);
    }
  }
  return means;
}

inline void expect_alike(const file::Picture& a, const file::Picture& b) {
  // A page whose size is no whole number of points may be a pixel wider.
  ASSERT_NEAR(a.width, b.width, 1);
  ASSERT_NEAR(a.height, b.height, 1);
  const int width = std::min(a.width, b.width);
  const int height = std::min(a.height, b.height);
  const std::vector<double> first = coarse(a, width, height);
  const std::vector<double> second = coarse(b, width, height);
  double largest = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    largest = std::max(largest, std::abs(first[i] - second[i]));
    sum += std::abs(first[i] - second[i]);
  }
  EXPECT_LT(largest, 50.0);
  EXPECT_LT(sum / static_cast<double>(first.size()), 1.0);
}

constexpr const char* kNoPrograms = "there is no rsvg-convert or pdftocairo";
inline bool can_draw_vector_files() {
  return std::system("command -v rsvg-convert >/dev/null && command -v pdftocairo >/dev/null") == 0;
}

// SVG and PDF show what the PNG shows. Skips without the programs of Debian that draw them.
inline void expect_same_in_vector_files(const DrawWith& draw) {
  if (!can_draw_vector_files()) GTEST_SKIP() << kNoPrograms;
  const file::Picture png = decode_png(FigureFile(draw, ".png").bytes());
  for (const char* ending : {".svg", ".PDF"}) expect_alike(png, FigureFile(draw, ending).drawn());
}

}  // namespace hapticwall::test
