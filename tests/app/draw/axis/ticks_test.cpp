#include "app/draw/axis/ticks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hapticwall::draw {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> texts_of(const std::vector<AxisTick>& ticks) {
  std::vector<std::string> texts;
  for (const AxisTick& tick : ticks) texts.push_back(tick.text);
  return texts;
}

TEST(Ticks, AreRoundNumbersWithAMinusOfTheFontAndWithoutAUnit) {
  EXPECT_THAT(texts_of(round_ticks(0.0, 6.0, 7)), ElementsAre("0", "1", "2", "3", "4", "5", "6"));
  EXPECT_THAT(texts_of(round_ticks(-1.1, 1.1, 5)), ElementsAre("−1.0", "−0.5", "0", "0.5", "1.0"));
  EXPECT_THAT(texts_of(round_ticks(0.0, 3e6, 4)), ElementsAre("0", "10⁶", "2·10⁶", "3·10⁶"));
  EXPECT_THAT(texts_of(round_ticks(0.0, 2e-6, 3)), ElementsAre("0", "10⁻⁶", "2·10⁻⁶"));
}

TEST(Ticks, TheEndOfAnAxisMissesItsTickByNoRoundOff) {
  EXPECT_EQ(round_ticks(0.0, 5.999 + 0.001, 7).back().text, "6");
  EXPECT_EQ(round_ticks(0.1 + 0.2, 0.9, 7).front().text, "0.3");
}

TEST(Ticks, EveryAxisHasTwoAndNoneIsBesideIt) {
  std::mt19937_64 random(20261126);
  std::uniform_real_distribution<double> middle(-100.0, 100.0);
  std::uniform_real_distribution<double> power(-4.0, 6.0);
  for (int i = 0; i < 10000; ++i) {
    const double low = middle(random);
    const double high = low + std::pow(10.0, power(random));
    const int max_count = 2 + i % 8;
    const std::vector<AxisTick> ticks = round_ticks(low, high, max_count);
    ASSERT_GE(ticks.size(), 2U) << low << " to " << high;
    ASSERT_LE(ticks.size(), std::max<std::size_t>(5, static_cast<std::size_t>(max_count)));
    const double room = 1e-6 * (high - low);
    ASSERT_GE(ticks.front().value, low - room);
    ASSERT_LE(ticks.back().value, high + room);
  }
}

TEST(Symlog, IsOddAndOneDecadeATenfold) {
  EXPECT_EQ(to_symlog(0.0, 2.0), 0.0);
  EXPECT_EQ(to_symlog(-30.0, 2.0), -to_symlog(30.0, 2.0));
  EXPECT_NEAR(to_symlog(2e6, 2.0) - to_symlog(2e5, 2.0), 1.0, 1e-5);
  EXPECT_NEAR(to_symlog(1e-3, 2.0), 1e-3 / 2.0 / std::log(10.0), 1e-6) << "linear around 0";
}

TEST(Symlog, TicksStandAtTheirNumbers) {
  const double end = to_symlog(1000.0, 10.0);
  const std::vector<AxisTick> ticks = symlog_ticks(-end, end, 10.0, 0.1);
  EXPECT_THAT(texts_of(ticks), ElementsAre("−1000", "−100", "−10", "0", "10", "100", "1000"));
  EXPECT_EQ(ticks.back().value, end);
  EXPECT_EQ(ticks[5].value, to_symlog(100.0, 10.0));
}

TEST(Symlog, ALabelWithoutRoomIsLeftOutAndItsTickStays) {
  const double end = to_symlog(1000.0, 10.0);
  EXPECT_THAT(texts_of(symlog_ticks(-end, end, 10.0, 0.9)),
              ElementsAre("−1000", "−100", "", "0", "", "100", "1000"));
  EXPECT_THAT(texts_of(symlog_ticks(-end, end, 10.0, 1.5)),
              ElementsAre("−1000", "", "", "0", "", "", "1000"));
}

}  // namespace
}  // namespace hapticwall::draw
