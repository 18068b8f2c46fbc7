#include "app/ui/sample_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace hapticwall::ui {
namespace {

constexpr double kPeriodS = 1e-3;

Sample sample_at(std::uint64_t tick, double force_n) {
  Sample sample;
  sample.tick = tick;
  sample.time_s = static_cast<double>(tick) * kPeriodS;
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
  const SampleHistory history = noisy_history(100, 1234);
  ASSERT_GE(history.size(), 100U);
  ASSERT_LE(history.size(), 200U);
  const auto time = history.column(Quantity::kTime);
  EXPECT_TRUE(std::is_sorted(time.begin(), time.end()));
  EXPECT_DOUBLE_EQ(history.newest_time_s(), 1233 * kPeriodS);
  EXPECT_DOUBLE_EQ(history.column(Quantity::kForce).back(), noise(1233));
}

TEST(SampleHistory, ForgetsEverythingWhenTheTicksStartAgain) {
  SampleHistory history = noisy_history(100, 50);
  history.push(sample_at(0, 7.0));
  ASSERT_EQ(history.size(), 1U);
  EXPECT_DOUBLE_EQ(history.column(Quantity::kForce).front(), 7.0);
}

TEST(SampleHistory, KeepsEveryQuantityInItsOwnColumn) {
  Sample sample;
  sample.time_s = 1;
  sample.position_m = 2;
  sample.truth.position_m = 3;
  sample.truth.hand_path_m = 4;
  sample.force_n = 5;
  sample.wall_force_n = 6;
  sample.stiffness_n_per_m = 7;
  sample.energy_cv_j = 8;
  sample.energy_hold_j = 9;
  sample.energy_scv_j = 10;
  sample.energy_budget_j = 11;
  SampleHistory history(10);
  history.push(sample);
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    EXPECT_DOUBLE_EQ(history.column(static_cast<Quantity>(i)).front(),
                     static_cast<double>(i) + 1.0);
  }
}

TEST(SampleHistory, ARangeReachesOneSampleBeyondEitherEdge) {
  const SampleHistory history = noisy_history(1000, 1000);
  const IndexRange range = history.range(0.1005, 0.2005);
  const auto time = history.column(Quantity::kTime);
  EXPECT_LT(time[range.first], 0.1005);
  EXPECT_GE(time[range.first + 1], 0.1005);
  EXPECT_GT(time[range.last - 1], 0.2005);
  EXPECT_LE(time[range.last - 2], 0.2005);
  EXPECT_EQ(history.range(-5.0, 100.0).count(), 1000U);
  EXPECT_EQ(SampleHistory(10).range(0.0, 1.0).count(), 0U);
}

// Against brute force: the points are exactly the extremes of their group, for every group.
TEST(SampleHistory, DecimationKeepsTheExtremesOfEveryColumn) {
  constexpr double kScale = 1e3;
  for (const std::uint64_t count : {1000ULL, 4321ULL, 100000ULL}) {
    for (const std::size_t columns : {7U, 100U, 433U}) {
      const SampleHistory history = noisy_history(100000, count);
      const IndexRange range = history.range(0.0123, static_cast<double>(count) * kPeriodS * 0.9);
      Trace trace;
      history.decimate(Quantity::kForce, range, columns, kScale, trace);
      ASSERT_EQ(trace.time_s.size(), trace.value.size());
      ASSERT_LE(trace.value.size(), 2 * columns);
      EXPECT_TRUE(std::is_sorted(trace.time_s.begin(), trace.time_s.end()));

      const std::size_t group = (range.count() + columns - 2) / (columns - 1);
      std::size_t point = 0;
      for (std::size_t first = range.first; first < range.last;) {
        const std::size_t last = std::min(range.last, (first / group + 1) * group);
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (std::size_t i = first; i < last; ++i) {
          low = std::min(low, noise(i));
          high = std::max(high, noise(i));
        }
        const std::size_t points = low == high ? 1 : 2;
        ASSERT_LE(point + points, trace.value.size());
        EXPECT_EQ(std::min(trace.value[point], trace.value[point + points - 1]), low * kScale);
        EXPECT_EQ(std::max(trace.value[point], trace.value[point + points - 1]), high * kScale);
        EXPECT_GE(trace.time_s[point], static_cast<double>(first) * kPeriodS);
        EXPECT_LE(trace.time_s[point + points - 1], static_cast<double>(last - 1) * kPeriodS);
        point += points;
        first = last;
      }
      EXPECT_EQ(point, trace.value.size());
    }
  }
}

TEST(SampleHistory, FewSamplesArePlottedAsTheyAre) {
  const SampleHistory history = noisy_history(100, 60);
  Trace trace;
  history.decimate(Quantity::kForce, history.range(0.0, 1.0), 500, 1.0, trace);
  ASSERT_EQ(trace.value.size(), 60U);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(trace.value[i], noise(i));
}

TEST(SampleHistory, ASpikeOfOneSampleIsNeverLost) {
  SampleHistory history(100000);
  constexpr std::uint64_t kSpike = 54321;
  for (std::uint64_t tick = 0; tick < 100000; ++tick)
    history.push(sample_at(tick, tick == kSpike ? -9.0 : 1.0));
  Trace trace;
  history.decimate(Quantity::kForce, history.range(0.0, 100.0), 300, 1.0, trace);
  EXPECT_EQ(*std::min_element(trace.value.begin(), trace.value.end()), -9.0);
}

// What was drawn stays as it was while the window moves on: pictures do not flicker.
TEST(SampleHistory, GroupsDoNotMoveWithTheWindow) {
  // The next samples push the oldest out, by a count that is no multiple of a group.
  SampleHistory history = noisy_history(2003, 10000);
  constexpr std::size_t kColumns = 100;
  const auto points_within = [&](double from_s, double to_s) {
    Trace trace;
    const double newest_s = history.newest_time_s();
    history.decimate(Quantity::kForce, history.range(newest_s - 1.5, newest_s), kColumns, 1.0,
                     trace);
    std::vector<double> values;
    for (std::size_t i = 0; i < trace.value.size(); ++i) {
      if (trace.time_s[i] > from_s && trace.time_s[i] < to_s) values.push_back(trace.value[i]);
    }
    std::sort(values.begin(), values.end());
    return values;
  };
  const std::vector<double> before = points_within(9.0, 9.5);
  for (std::uint64_t tick = 10000; tick < 10020; ++tick) history.push(sample_at(tick, noise(tick)));
  EXPECT_FALSE(before.empty());
  EXPECT_EQ(points_within(9.0, 9.5), before);
}

}  // namespace
}  // namespace hapticwall::ui
