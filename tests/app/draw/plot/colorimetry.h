// Colours as the eye sees them: linear light, CIE L*a*b* and contrast.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace hapticwall::test {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

// IEC 61966-2-1 (sRGB), to CIE XYZ relative to the white D65.
constexpr Matrix kXyz{{{0.4124564, 0.3575761, 0.1804375},
                       {0.2126729, 0.7151522, 0.0721750},
                       {0.0193339, 0.1191920, 0.9503041}}};
constexpr Vector kWhite{0.95047, 1.0, 1.08883};

inline Vector product(const Matrix& matrix, const Vector& v) {
  Vector result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
  return result;
}

inline Vector linear(const ImVec4& colour) {
  Vector v{static_cast<double>(colour.x), static_cast<double>(colour.y),
           static_cast<double>(colour.z)};
  for (double& c : v) c = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  return v;
}

// CIE 1976 L*a*b* of linear light.
inline Vector lab(const Vector& rgb) {
  Vector f = product(kXyz, rgb);
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = f[i] / kWhite[i];
    f[i] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  }
  return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

// L*, 0 to 100.
inline double lightness(const ImVec4& colour) { return lab(linear(colour))[0]; }

// WCAG 2.2, 1 to 21.
inline double contrast(const ImVec4& a, const ImVec4& b) {
  const auto luminance = [](const ImVec4& colour) { return product(kXyz, linear(colour))[1]; };
  const auto [dark, light] = std::minmax(luminance(a), luminance(b));
  return (light + 0.05) / (dark + 0.05);
}

}  // namespace hapticwall::test
