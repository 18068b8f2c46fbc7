#include "app/draw/plot/sample_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

namespace hapticwall::draw {
namespace {

constexpr double kHistoryPeriodS = 1e-3;

Sample sample_at(std::uint64_t tick, double force_n) {
  Sample sample;
  sample.tick = tick;
  sample.time_s = static_cast<double>(tick) * kHistoryPeriodS;
  sample.force_n = force_n;
  return sample;
}

// Looks random, is the same every time.
double noise(std::uint64_t tick) {
  std::uint64_t bits = tick * 6364136223846793005ULL + 1442695040888963407ULL;
  bits ^= bits >> 29U;
  bits *= 2862933555777941757ULL;
  return static_cast<double>(bits >> 40U) / static_cast<double>(1U << 24U) - 0.5;
}

SampleHistory noisy_history(std::size_t capacity, std::uint64_t count) {
  SampleHistory history(capacity);
  for (std::uint64_t tick = 0; tick < count; ++tick) history.push(sample_at(tick, noise(tick)));
  return history;
}

TEST(SampleHistory, KeepsAtLeastTheNewestOfItsCapacityInOrder) {
  constexpr std::size_t kCapacity = 5000;
  SampleHistory history(kCapacity);
  for (std::uint64_t tick = 0; tick < 30000; ++tick) {
    history.push(sample_at(tick, noise(tick)));
    ASSERT_GE(history.size(), std::min<std::size_t>(kCapacity, tick + 1));
    ASSERT_LE(history.size(), kCapacity + BlockArray<double>::kBlock);
  }
  const std::size_t newest = history.size() - 1;
  for (std::size_t i = 0; i <= newest; ++i) {
    const std::uint64_t tick = 29999 - (newest - i);
    ASSERT_EQ(history.value(&Sample::tick, i), static_cast<double>(tick));
    ASSERT_EQ(history.value(&Sample::force_n, i), noise(tick));
  }
  EXPECT_DOUBLE_EQ(history.newest_time_s(), 29999 * kHistoryPeriodS);
  EXPECT_DOUBLE_EQ(history.oldest_time_s(), static_cast<double>(29999 - newest) * kHistoryPeriodS);
}

TEST(SampleHistory, ForgetsEverythingWhenTheTicksStartAgain) {
  SampleHistory history = noisy_history(100, 50);
  history.push(sample_at(0, 7.0));
  ASSERT_EQ(history.size(), 1U);
  EXPECT_DOUBLE_EQ(history.value(&Sample::force_n, 0), 7.0);
  EXPECT_DOUBLE_EQ(history.extremes(&Sample::force_n, {0, 1}).minimum, 7.0);
}

// All numbers differ: none is kept in the place of another.
TEST(SampleHistory, GivesBackTheSampleThatWasPushed) {
  Sample sample;
  std::uint32_t next = 1;
  for_each_column(sample, [&]<typename Value>(const SampleColumn& /*column*/, Value& value) {
    value = static_cast<Value>(next++);
  });
  sample.tick = (std::uint64_t{1} << 53U) - 1;
  SampleHistory history(10);
  history.push(sample);
  const Sample again = history.sample(0);
  EXPECT_TRUE(all_columns(again, sample, [](const SampleColumn& column, auto kept, auto pushed) {
    EXPECT_EQ(kept, pushed) << column.name;
    return kept == pushed;
  }));
}

TEST(SampleHistory, ACopyStaysAsItWasWhileTheOriginalGoesOn) {
  SampleHistory history = noisy_history(3000, 2500);
  const SampleHistory copy = history;
  for (std::uint64_t tick = 2500; tick < 20000; ++tick) history.push(sample_at(tick, 5.0));
  ASSERT_EQ(copy.size(), 2500U);
  for (std::size_t i = 0; i < copy.size(); ++i)
    ASSERT_EQ(copy.value(&Sample::force_n, i), noise(i));
}

TEST(SampleHistory, TheNearestSampleIsOnEitherSide) {
  const SampleHistory history = noisy_history(100, 50);
  EXPECT_EQ(history.nearest(0.0204), 20U);
  EXPECT_EQ(history.nearest(0.0206), 21U);
  EXPECT_EQ(history.nearest(-3.0), 0U);
  EXPECT_EQ(history.nearest(9.0), 49U);
  EXPECT_FALSE(SampleHistory(10).nearest(0.0).has_value());
}

TEST(SampleHistory, ARangeWithinHasNothingBeyondItsEdges) {
  const SampleHistory history = noisy_history(1000, 1000);
  const IndexRange range = history.range_within(0.1, 0.2);
  EXPECT_EQ(history.value(&Sample::time_s, range.first), 0.1);
  EXPECT_EQ(history.value(&Sample::time_s, range.last - 1), 0.2);
  EXPECT_EQ(history.range_within(0.1001, 0.1009).count(), 0U);
  EXPECT_EQ(history.range_within(5.0, 6.0).count(), 0U);
  EXPECT_EQ(history.range_within(0.5, 0.1).count(), 0U);
}

TEST(SampleHistory, ARangeReachesOneSampleBeyondEitherEdge) {
  const SampleHistory history = noisy_history(1000, 1000);
  const IndexRange range = history.range(0.1005, 0.2005);
  const auto time_s = [&](std::size_t i) { return history.value(&Sample::time_s, i); };
  EXPECT_LT(time_s(range.first), 0.1005);
  EXPECT_GE(time_s(range.first + 1), 0.1005);
  EXPECT_GT(time_s(range.last - 1), 0.2005);
  EXPECT_LE(time_s(range.last - 2), 0.2005);
  EXPECT_EQ(history.range(-5.0, 100.0).count(), 1000U);
  EXPECT_EQ(SampleHistory(10).range(0.0, 1.0).count(), 0U);
}

struct ColumnExtremes {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

TEST(DecimationGroup, IsNeverWiderThanAColumnAndNotMuchNarrower) {
  std::mt19937_64 random(20240607);
  for (int trial = 0; trial < 5000; ++trial) {
    const std::size_t columns = 1 + random() % 2000;
    const std::size_t samples = random() % 3'600'001;
    const std::size_t group = decimation_group(samples, columns);
    ASSERT_GE(group, 1U);
    ASSERT_LE(group, std::max<std::size_t>(samples / columns, 1));
    ASSERT_GT(5 * group, 4 * (samples / columns)) << samples << " in " << columns;
  }
}

// Against brute force, over random ranges and widths: of every group exactly the smallest and the
// largest sample are drawn, at times within the group.
TEST(SampleHistory, DecimationKeepsTheExtremesOfEveryGroupOverRandomRanges) {
  constexpr double kScale = 1e3;
  constexpr std::uint64_t kCount = 100000;
  const SampleHistory history = noisy_history(kCount, kCount);
  std::mt19937_64 random(20240608);
  Trace trace;
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t columns = 2 + random() % 1500;
    const std::size_t first = random() % (kCount - 1);
    const std::size_t most = trial % 2 == 0 ? kCount : 6 * columns;
    const std::size_t end = first + 1 + random() % std::min(kCount - first, most);
    history.decimate(&Sample::force_n, {first, end}, columns, kScale, trace);
    const std::size_t group = decimation_group(end - first, columns);
    std::size_t point = 0;
    for (std::size_t from = first; from < end;) {
      const std::size_t to = std::min((from / group + 1) * group, end);
      ColumnExtremes there;
      for (std::size_t i = from; i < to; ++i) there.include(noise(i) * kScale);
      const std::size_t points = std::min<std::size_t>(to - from, 2);
      ASSERT_LE(point + points, trace.value.size());
      ColumnExtremes drawn;
      for (std::size_t i = point; i < point + points; ++i) drawn.include(trace.value[i]);
      ASSERT_EQ(drawn.low, there.low);
      ASSERT_EQ(drawn.high, there.high);
      for (std::size_t i = point; i < point + points; ++i) {
        ASSERT_GE(trace.time_s[i], static_cast<double>(from) * kHistoryPeriodS);
        ASSERT_LE(trace.time_s[i], static_cast<double>(to - 1) * kHistoryPeriodS);
      }
      from = to;
      point += points;
    }
    ASSERT_EQ(point, trace.value.size());
  }
}

// Large groups are made of whole blocks: as exact, and not much smaller than a column.
TEST(SampleHistory, DecimationOfTenMinutesIsExactAndHasTwoPointsAColumn) {
  constexpr std::uint64_t kCount = 600'000;
  constexpr std::size_t kColumns = 1000;
  const SampleHistory history = noisy_history(kCount, kCount);
  Trace trace;
  history.decimate(&Sample::force_n, {123, kCount - 77}, kColumns, 1.0, trace);
  EXPECT_GE(trace.value.size(), 2 * kColumns);
  EXPECT_LE(trace.value.size(), 2 * kColumns * 5 / 4 + 4);
  ColumnExtremes drawn;
  for (const double value : trace.value) drawn.include(value);
  ColumnExtremes all;
  for (std::uint64_t tick = 123; tick < kCount - 77; ++tick) all.include(noise(tick));
  EXPECT_EQ(drawn.low, all.low);
  EXPECT_EQ(drawn.high, all.high);
  EXPECT_EQ(history.extremes(&Sample::force_n, {123, kCount - 77}).minimum, all.low);
}

TEST(SampleHistory, AtTwoSamplesAColumnEverySampleIsDrawn) {
  const SampleHistory history = noisy_history(5000, 5000);
  Trace trace;
  history.decimate(&Sample::force_n, {100, 1900}, 650, 1.0, trace);
  ASSERT_EQ(trace.value.size(), 1800U);
  for (std::size_t i = 0; i < 1800; ++i) ASSERT_EQ(trace.value[i], noise(100 + i));
}

TEST(SampleHistory, ASpikeOfOneSampleIsNeverLost) {
  SampleHistory history(100000);
  constexpr std::uint64_t kSpike = 54321;
  for (std::uint64_t tick = 0; tick < 100000; ++tick)
    history.push(sample_at(tick, tick == kSpike ? -9.0 : 1.0));
  Trace trace;
  history.decimate(&Sample::force_n, history.range(0.0, 100.0), 300, 1.0, trace);
  EXPECT_EQ(*std::min_element(trace.value.begin(), trace.value.end()), -9.0);
}

// Drawn points stay as they are while the window moves on, so that pictures do not flicker.
TEST(SampleHistory, GroupsDoNotMoveWithTheWindow) {
  // The next samples push the oldest out, by a count that is no multiple of a group.
  SampleHistory history = noisy_history(2003, 10000);
  constexpr std::size_t kColumns = 100;
  const auto points_within = [&](double first_s, double last_s) {
    Trace trace;
    const double newest_s = history.newest_time_s();
    history.decimate(&Sample::force_n, history.range(newest_s - 1.5, newest_s), kColumns, 1.0,
                     trace);
    std::vector<double> values;
    for (std::size_t i = 0; i < trace.value.size(); ++i) {
      if (trace.time_s[i] > first_s && trace.time_s[i] < last_s) values.push_back(trace.value[i]);
    }
    std::sort(values.begin(), values.end());
    return values;
  };
  // The range is from the first sample of a group of 15 to the last of another.
  const double from_s = 8.9995;
  const double to_s = 9.4945;
  const std::vector<double> before = points_within(from_s, to_s);
  for (std::uint64_t tick = 10000; tick < 10020; ++tick) history.push(sample_at(tick, noise(tick)));
  EXPECT_EQ(before.size(), 2U * 33U);
  EXPECT_EQ(points_within(from_s, to_s), before);
}

}  // namespace
}  // namespace hapticwall::draw
