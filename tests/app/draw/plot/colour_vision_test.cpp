// Lines that share a plot, as people with deuteranopia see them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "app/draw/plot/plot_lines.h"
#include "app/draw/plot/theme.h"
#include "tests/app/draw/plot/colorimetry.h"

namespace hapticwall::draw {
namespace {

using test::lab;
using test::linear;
using test::Matrix;
using test::product;
using test::Vector;

// Machado, Oliveira, Fernandes: A Physiologically-based Model for Simulation of Color Vision
// Deficiency, IEEE TVCG 15 (2009), deuteranomaly of severity 1.0; of linear RGB.
constexpr Matrix kDeuteranopia{{{0.367322, 0.860646, -0.227968},
                                {0.280085, 0.672501, 0.047413},
                                {-0.011820, 0.042940, 0.968881}}};

Vector as_seen(const ImVec4& colour) {
  Vector v = product(kDeuteranopia, linear(colour));
  for (double& c : v) c = std::clamp(c, 0.0, 1.0);
  return v;
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
