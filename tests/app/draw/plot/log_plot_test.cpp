#include "app/draw/plot/log_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hapticwall::draw {
namespace {

using ::testing::ElementsAre;

// Each text that stands beside the axis, where the number that it says belongs.
MATCHER_P2(Says, text, value, "") {
  return arg.text == text && std::abs(arg.value / value - 1.0) < 1e-12;
}

TEST(LogPlot, AnAxisOfManyDecadesNamesSomeOfThem) {
  EXPECT_THAT(axis_numbers({-16.4, -3.6}),
              ElementsAre(Says("10⁻¹⁶", 1e-16), Says("10⁻¹⁴", 1e-14), Says("10⁻¹²", 1e-12),
                          Says("10⁻¹⁰", 1e-10), Says("10⁻⁸", 1e-8), Says("10⁻⁶", 1e-6),
                          Says("10⁻⁴", 1e-4)));
  EXPECT_THAT(axis_numbers({-2.2, 4.1}),
              ElementsAre(Says("0.01", 0.01), Says("0.1", 0.1), Says("1", 1.0), Says("10", 10.0),
                          Says("100", 100.0), Says("1000", 1000.0), Says("10⁴", 1e4)));
}

TEST(LogPlot, AnAxisOfLessThanTwoDecadesNamesWhatIsBetween) {
  EXPECT_THAT(axis_numbers({1.2, 2.6}), ElementsAre(Says("20", 20.0), Says("50", 50.0),
                                                    Says("100", 100.0), Says("200", 200.0)));
  EXPECT_THAT(axis_numbers({-8.8, -8.2}), ElementsAre(Says("2·10⁻⁹", 2e-9), Says("5·10⁻⁹", 5e-9)));
}

TEST(LogPlot, AnAxisOfHalfADecadeNamesEveryDigit) {
  EXPECT_THAT(axis_numbers({1.31, 1.81}),
              ElementsAre(Says("30", 30.0), Says("40", 40.0), Says("50", 50.0), Says("60", 60.0)));
}

TEST(LogPlot, EveryAxisHasTwoNumbersAndNoneBesideIt) {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> place(-20.0, 20.0);
  std::uniform_real_distribution<double> width(0.5, 3.0);
  for (int i = 0; i < 10000; ++i) {
    const double from = place(random);
    const Decades axis{from, from + width(random)};
    const std::vector<AxisNumber> numbers = axis_numbers(axis);
    ASSERT_GE(numbers.size(), 2U) << axis.from << " to " << axis.to;
    for (const AxisNumber& number : numbers) {
      ASSERT_GE(number.value, std::pow(10.0, axis.from) * (1.0 - 1e-12));
      ASSERT_LE(number.value, std::pow(10.0, axis.to) * (1.0 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace hapticwall::draw
