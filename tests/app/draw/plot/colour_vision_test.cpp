// Lines that share a plot, as people with deuteranopia see them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "app/draw/plot/plot_lines.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

// Machado, Oliveira, Fernandes: A Physiologically-based Model for Simulation of Color Vision
// Deficiency, IEEE TVCG 15 (2009), deuteranomaly of severity 1.0; of linear RGB.
constexpr Matrix kDeuteranopia{{{0.367322, 0.860646, -0.227968},
                                {0.280085, 0.672501, 0.047413},
                                {-0.011820, 0.042940, 0.968881}}};
// IEC 61966-2-1 (sRGB), to CIE XYZ relative to the white D65.
constexpr Matrix kXyz{{{0.4124564, 0.3575761, 0.1804375},
                       {0.2126729, 0.7151522, 0.0721750},
                       {0.0193339, 0.1191920, 0.9503041}}};
constexpr Vector kWhite{0.95047, 1.0, 1.08883};

Vector product(const Matrix& matrix, const Vector& v) {
  Vector result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
  return result;
}

Vector linear(const ImVec4& colour) {
  Vector v{static_cast<double>(colour.x), static_cast<double>(colour.y),
           static_cast<double>(colour.z)};
  for (double& c : v) c = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  return v;
}

Vector as_seen(const ImVec4& colour) {
  Vector v = product(kDeuteranopia, linear(colour));
  for (double& c : v) c = std::clamp(c, 0.0, 1.0);
  return v;
}

// CIE 1976 L*a*b*.
Vector lab(const Vector& rgb) {
  Vector f = product(kXyz, rgb);
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = f[i] / kWhite[i];
    f[i] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  }
  return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

// ΔE of 1976: 2.3 is just noticeable.
double distance(const Vector& a, const Vector& b) {
  const Vector x = lab(a);
  const Vector y = lab(b);
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

bool is_usual(const PlotDescription& plot, const PlotLine& line) {
  return (usual_lines()[static_cast<std::size_t>(plot.id)] & line_bit(line.quantity)) != 0U;
}

void expect_apart(Look look, const PlotDescription& plot, const PlotLine& a, const PlotLine& b) {
  constexpr double kApart = 20.0;
  const auto colour = [&](const PlotLine& line) {
    return theme_colours(look)[static_cast<std::size_t>(line.tone)];
  };
  const std::string pair = std::string(plot.title) + ": " + a.name + ", " + b.name;
  const bool dashes_differ = a.dash != b.dash;
  // Lines of the first look differ by their colour alone.
  if (!dashes_differ || (is_usual(plot, a) && is_usual(plot, b))) {
    EXPECT_GT(distance(as_seen(colour(a)), as_seen(colour(b))), kApart) << pair;
    EXPECT_GT(distance(linear(colour(a)), linear(colour(b))), kApart) << pair;
  }
}

TEST(ColourVision, AllLinesThatShareAPlotAreToldApartInEveryLook) {
  for (const Look look : {Look::kScreen, Look::kLight, Look::kPrint}) {
    SCOPED_TRACE(static_cast<int>(look));
    for (const PlotId id : kAllPlots) {
      const PlotDescription& plot = plot_description(id);
      for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) expect_apart(look, plot, plot.lines[i], plot.lines[j]);
      }
    }
  }
}

// The test's own eyes: red and green of the same lightness are one colour for them, blue and orange
// are not.
TEST(ColourVision, TheSimulationTakesRedAndGreenForOne) {
  const ImVec4 red{0.80F, 0.30F, 0.25F, 1.0F};
  const ImVec4 green{0.44F, 0.52F, 0.20F, 1.0F};
  const ImVec4 blue{0.0F, 0.45F, 0.70F, 1.0F};
  EXPECT_GT(distance(linear(red), linear(green)), 50.0);
  EXPECT_LT(distance(as_seen(red), as_seen(green)), 20.0);
  EXPECT_GT(distance(as_seen(red), as_seen(blue)), 50.0);
}

}  // namespace
}  // namespace hapticwall::draw
