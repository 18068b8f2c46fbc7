// The paper of a figure: its printed width, and lengths on it.
#pragma once

#include <cstdint>

namespace hapticwall::draw {

// Shapes are for vector files.
enum class Ink : std::uint8_t { kPixels, kShapes };

// Widths of one and of two columns of a journal. IEEE has 88.9 and 182 mm, Elsevier 90 and 190 mm:
// a figure of these widths is included without scaling.
inline constexpr double kSingleWidthMm = 86.0;
inline constexpr double kDoubleWidthMm = 178.0;
inline constexpr double kMinWidthMm = 80.0;   // a narrower page has no room for its legends
inline constexpr double kMaxWidthMm = 420.0;  // long side of A3

// The content decides the height.
struct Paper {
  double width_mm = kDoubleWidthMm;
  Ink ink = Ink::kPixels;

  [[nodiscard]] constexpr Paper in(Ink other) const { return {width_mm, other}; }
  // True if panels stand below each other that a wide page has side by side.
  [[nodiscard]] constexpr bool narrow() const { return width_mm < 120.0; }
};

// All figures are laid out in pixels of this size. A PNG has these pixels.
inline constexpr double kDotsPerInch = 300.0;
inline constexpr double kMillimetresPerInch = 25.4;
inline constexpr double kPointsPerInch = 72.0;

[[nodiscard]] constexpr float pixels_of_mm(double length_mm) {
  return static_cast<float>(length_mm * kDotsPerInch / kMillimetresPerInch);
}
[[nodiscard]] constexpr double points_of_pixels(double pixels) {
  return pixels * kPointsPerInch / kDotsPerInch;
}

// Width of a column of a band, by that of a window with the same lines: paper is read closely.
inline constexpr float kColumnShare = 0.75F;

// Scale of Dear ImGui's sizes at which kSmallFontSize is 7 pt on paper; kFontSize is then 8.1 pt.
// Dear ImGui measures a font by its line, which has 1.2102 em in Inter.
[[nodiscard]] float print_scale();

}  // namespace hapticwall::draw
