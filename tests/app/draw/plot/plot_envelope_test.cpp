#include "app/draw/plot/plot_envelope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <vector>

namespace hapticwall::draw {
namespace {

constexpr double kPeriodS = 1e-3;
constexpr PixelScale kX{100.0, 120.0};  // 120 pixels a second
constexpr PixelScale kY{300.0, -40.0};  // upwards

// Chatter with rare spikes; `samples` from time 0.
SampleHistory chatter(std::uint64_t samples) {
  std::mt19937_64 random(7);
  SampleHistory history(static_cast<std::size_t>(samples));
  for (std::uint64_t tick = 0; tick < samples; ++tick) {
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) * kPeriodS;
    sample.force_n = static_cast<double>(random() % 1000) / 250.0;
    if (random() % 500 == 0) sample.force_n = -3.0;
    history.push(sample);
  }
  return history;
}

Trace trace_of(const SampleHistory& history, std::size_t columns) {
  Trace trace;
  history.decimate(&Sample::force_n, {0, history.size()}, columns, 1.0, trace);
  return trace;
}

TEST(PlotEnvelope, ManyStrokesInAPixelAreABandAndAFewAreNot) {
  EXPECT_TRUE(is_band(trace_of(chatter(6000), 720), kX, kY));
  Trace slow;
  for (int i = 0; i < 720; ++i) {
    slow.time_s.push_back(i / 120.0);
    slow.value.push_back(std::sin(i / 120.0));
  }
  EXPECT_FALSE(is_band(slow, kX, kY));
  // Far up and down, but with room between the strokes.
  EXPECT_FALSE(is_band(trace_of(chatter(60), 720), {100.0, 12000.0}, kY));
  EXPECT_FALSE(is_band({}, kX, kY));
}

// Against brute force: every sample is in the band, in its own column of pixels or the one beside
// it, and the band reaches nowhere where no sample is.
TEST(PlotEnvelope, EveryExtremeIsInTheBandWithinAPixelOfItsTime) {
  const SampleHistory history = chatter(6000);
  std::vector<PixelColumn> columns;
  band_of(trace_of(history, 720), kX, kY, columns);
  std::map<int, PixelColumn> by_x;
  for (const PixelColumn& column : columns) by_x[column.x] = column;
  double top = std::numeric_limits<double>::infinity();
  double bottom = -top;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const double y = kY(history.value(&Sample::force_n, i));
    const int x = static_cast<int>(std::floor(kX(history.value(&Sample::time_s, i))));
    top = std::min(top, y);
    bottom = std::max(bottom, y);
    bool found = false;
    for (int near = x - 1; near <= x + 1; ++near) {
      const auto column = by_x.find(near);
      found =
          found || (column != by_x.end() && column->second.top <= y && column->second.bottom >= y);
    }
    ASSERT_TRUE(found) << i;
  }
  double band_top = std::numeric_limits<double>::infinity();
  double band_bottom = -band_top;
  for (const PixelColumn& column : columns) {
    band_top = std::min(band_top, column.top);
    band_bottom = std::max(band_bottom, column.bottom);
  }
  EXPECT_EQ(band_top, top);  // nothing is made up
  EXPECT_EQ(band_bottom, bottom);
}

TEST(PlotEnvelope, ColumnsAreJoinedAndNoneIsMissing) {
  std::vector<PixelColumn> columns;
  band_of(trace_of(chatter(6000), 720), kX, kY, columns);
  ASSERT_GT(columns.size(), 600U);
  for (std::size_t i = 1; i < columns.size(); ++i) {
    EXPECT_EQ(columns[i].x, columns[i - 1].x + 1);
    EXPECT_LE(columns[i].top, columns[i - 1].bottom);
    EXPECT_GE(columns[i].bottom, columns[i - 1].top);
  }
}

TEST(PlotEnvelope, AStepIsJoinedInOneColumn) {
  Trace step;
  for (int i = 0; i < 4; ++i) {
    step.time_s.push_back(i / 120.0);
    step.value.push_back(i < 2 ? 0.0 : 5.0);
  }
  std::vector<PixelColumn> columns;
  band_of(step, kX, kY, columns);
  ASSERT_EQ(columns.size(), 4U);
  EXPECT_EQ(columns[1].top, columns[1].bottom);
  EXPECT_EQ(columns[2].top, kY(5.0));
  EXPECT_EQ(columns[2].bottom, kY(0.0));
  EXPECT_EQ(columns[3].top, columns[3].bottom);
}

TEST(PlotEnvelope, CutsLinesFarOutsideToTheScreen) {
  Trace far;
  far.time_s = {0.0, 1e300, 1e305};
  far.value = {0.0, 1e300, -1e300};
  std::vector<PixelColumn> columns;
  band_of(far, kX, kY, columns);
  for (const PixelColumn& column : columns) {
    EXPECT_LE(std::abs(column.top), 1e5);
    EXPECT_LE(std::abs(column.bottom), 1e5);
    EXPECT_LE(std::abs(column.x), 100000);
  }
}

}  // namespace
}  // namespace hapticwall::draw
