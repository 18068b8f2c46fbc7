// The normalised chart by its pixels: a line and marks for each delay, the rule as a thin line.
#include "app/draw/figure/normalised_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "app/draw/plot/theme.h"
#include "tests/app/draw/figure/vector_files.h"
#include "tests/app/ui/pixels.h"

namespace hapticwall::draw {
namespace {

constexpr int kChartHeading = 150;  // title and legend, pixels of the full size
constexpr std::array kDelayTones{Tone::kPosition, Tone::kForce, Tone::kGood};

NormalisedChart simulated_on_the_limit() {
  NormalisedChart chart = chart_of_theory(Scene{});
  for (DelayChart& delay : chart.delays) {
    for (SimulatedPoint& point : delay.points) point.settled = point.failed = point.limit;
  }
  return chart;
}

file::Picture drawn(const NormalisedChart& chart) {
  const Result<file::Picture> figure = draw_normalised(chart);
  EXPECT_TRUE(figure.ok()) << (figure.ok() ? "" : figure.error().message);
  return figure.ok() ? *figure : file::Picture{};
}

test::Colour colour_of(Tone tone) {
  return test::colour_of(theme_colours(Look::kPrint)[static_cast<std::size_t>(tone)]);
}

int count(const file::Picture& figure, Tone tone) {
  return test::count_pixels(figure, colour_of(tone), 0, kChartHeading, figure.width, figure.height);
}

// The right end of a colour.
int right_of(const file::Picture& figure, Tone tone) {
  for (int x = figure.width - 1; x > 0; --x) {
    if (test::count_pixels(figure, colour_of(tone), x, kChartHeading, x + 1, figure.height) > 0)
      return x;
  }
  return 0;
}

TEST(NormalisedFigure, HasALineAndMarksForEachDelay) {
  const NormalisedChart chart = simulated_on_the_limit();
  const file::Picture whole = drawn(chart);
  ASSERT_EQ(whole.width, kNormalisedSize.width);
  for (std::size_t i = 0; i < kDelayTones.size(); ++i) {
    NormalisedChart without = chart;
    without.delays[i].points.clear();
    const file::Picture line = drawn(without);
    EXPECT_NE(line.rgba, whole.rgba) << i;
    EXPECT_GT(count(line, kDelayTones.at(i)), 800) << i;
    without.delays[i].curve.clear();
    EXPECT_EQ(count(drawn(without), kDelayTones.at(i)), 0) << i;
  }
}

TEST(NormalisedFigure, CurvesEndWhereNoWallIsStable) {
  const NormalisedChart chart = simulated_on_the_limit();
  const file::Picture figure = drawn(chart);
  const double unit = right_of(figure, kDelayTones[0]) - right_of(figure, kDelayTones[2]);
  const auto last = [&](std::size_t i) { return chart.delays[i].last_damping; };
  EXPECT_GT(unit, 800.0);
  EXPECT_NEAR((right_of(figure, kDelayTones[1]) - right_of(figure, kDelayTones[2])) / unit,
              (last(1) - last(2)) / (last(0) - last(2)), 0.01);
}

TEST(NormalisedFigure, TheRuleIsThinnerThanTheLimit) {
  NormalisedChart chart = simulated_on_the_limit();
  for (DelayChart& delay : chart.delays) delay.points.clear();
  NormalisedChart only_rule = chart;
  NormalisedChart only_limit = chart;
  for (std::size_t i = 0; i < chart.delays.size(); ++i) {
    for (ChartPoint& point : only_rule.delays[i].curve) {
      point.rule = point.limit;  // the same place for both
      point.limit = 0.0;
    }
    for (ChartPoint& point : only_limit.delays[i].curve) point.rule = 0.0;
  }
  const file::Picture rule = drawn(only_rule);
  const file::Picture limit = drawn(only_limit);
  const auto ink = [](const file::Picture& figure) {
    const int width = figure.width;
    return test::count_pixels(figure, colour_of(Tone::kPosition), 0, kChartHeading, width,
                              figure.height, 100);
  };
  EXPECT_GT(ink(rule), 500);
  EXPECT_GT(ink(limit), 1.5 * ink(rule));
}

TEST(NormalisedFigure, APointThatNothingSettlesAtIsLeftOut) {
  NormalisedChart chart = simulated_on_the_limit();
  const int all = count(drawn(chart), kDelayTones[0]);
  for (SimulatedPoint& point : chart.delays[0].points) point.settled.reset();
  EXPECT_GT(count(drawn(chart), kDelayTones[0]), all + 40);
}

TEST(NormalisedFigure, IsTheSameInVectorFiles) {
  const NormalisedChart chart = simulated_on_the_limit();
  test::expect_same_in_vector_files(
      [&](Ink ink) { return draw_normalised(chart, kNormalisedSize.in(ink)); });
}

}  // namespace
}  // namespace hapticwall::draw
