#include "app/ui/log_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace hapticwall::ui {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> texts(const Decades& decades) {
  std::vector<std::string> all;
  for (const AxisNumber& number : axis_numbers(decades)) all.push_back(number.text);
  return all;
}

TEST(LogPlot, AnAxisOfManyDecadesNamesSomeOfThem) {
  EXPECT_THAT(texts({-16.4, -3.6}),
              ElementsAre("10⁻¹⁶", "10⁻¹⁴", "10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴"));
  EXPECT_THAT(texts({-2.2, 4.1}), ElementsAre("0.01", "0.1", "1", "10", "100", "1000", "10⁴"));
}

TEST(LogPlot, AnAxisOfLessThanTwoDecadesNamesWhatIsBetween) {
  EXPECT_THAT(texts({1.2, 2.6}), ElementsAre("20", "50", "100", "200"));
  EXPECT_THAT(texts({1.2, 1.9}), ElementsAre("20", "50"));
  EXPECT_THAT(texts({-8.8, -8.2}), ElementsAre("2·10⁻⁹", "5·10⁻⁹"));
}

TEST(LogPlot, AnAxisOfHalfADecadeNamesEveryDigit) {
  EXPECT_THAT(texts({1.31, 1.81}), ElementsAre("30", "40", "50", "60"));
}

TEST(LogPlot, EveryAxisHasTwoNumbersWhereTheyBelong) {
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
      if (number.text.find("10") == std::string::npos || number.text.find("·") == std::string::npos)
        continue;
      ASSERT_EQ(number.text.front() - '0',
                std::lround(number.value / std::pow(10.0, std::floor(std::log10(number.value)))));
    }
  }
}

}  // namespace
}  // namespace hapticwall::ui
