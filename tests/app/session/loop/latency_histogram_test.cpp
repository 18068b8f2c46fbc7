#include "app/session/loop/latency_histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hapticwall::session {
namespace {

constexpr double kRelativeError = 1.0 / 32.0;

LatencyCounts counted(const std::vector<std::int64_t>& times_ns) {
  LatencyHistogram histogram;
  for (const std::int64_t time_ns : times_ns) histogram.add(time_ns);
  LatencyCounts counts;
  histogram.read(counts);
  return counts;
}

// Like latencies: mostly similar, a few a thousand times longer.
std::vector<std::int64_t> random_times(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::lognormal_distribution<double> times(9.0, 1.5);
  std::vector<std::int64_t> values(count);
  for (std::int64_t& value : values) value = static_cast<std::int64_t>(times(random));
  return values;
}

void expect_near(std::int64_t value, std::int64_t exact) {
  EXPECT_NEAR(static_cast<double>(value), static_cast<double>(exact),
              kRelativeError * static_cast<double>(exact));
}

TEST(LatencyBinsTest, AreInOrderAndRightToAThirtySecond) {
  std::size_t previous = 0;
  for (std::int64_t time_ns = 0; time_ns < 3'000'000'000; time_ns += 1 + time_ns / 50) {
    const std::size_t bin = LatencyBins::of(time_ns);
    ASSERT_GE(bin, previous) << time_ns;
    previous = bin;
    ASSERT_LE(LatencyBins::from_ns(bin), time_ns);
    ASSERT_GT(LatencyBins::from_ns(bin + 1), time_ns);
    const auto exact = static_cast<double>(time_ns);
    ASSERT_NEAR(static_cast<double>(LatencyBins::middle_ns(bin)), exact, exact * kRelativeError);
  }
}

TEST(LatencyBinsTest, TakeWhatNoClockCanHave) {
  EXPECT_EQ(LatencyBins::of(-1), 0U);
  EXPECT_EQ(LatencyBins::of(std::numeric_limits<std::int64_t>::min()), 0U);
  EXPECT_EQ(LatencyBins::of(std::numeric_limits<std::int64_t>::max()), LatencyBins::kCount - 1);
}

TEST(LatencyHistogramTest, QuantilesAreThoseOfTheSortedTimes) {
  for (const std::size_t count : {1U, 2U, 99U, 100U, 101U, 1000U, 20'000U}) {
    const std::vector<std::int64_t> times_ns = random_times(count, 7);
    const Quantiles exact = quantiles(times_ns);
    const Quantiles binned = quantiles(counted(times_ns));
    SCOPED_TRACE(count);
    EXPECT_EQ(binned.count, count);
    expect_near(binned.median_ns, exact.median_ns);
    expect_near(binned.p99_ns, exact.p99_ns);
    expect_near(binned.p999_ns, exact.p999_ns);
    EXPECT_EQ(binned.maximum_ns, exact.maximum_ns);
    EXPECT_LE(binned.p999_ns, binned.maximum_ns);
  }
}

TEST(LatencyHistogramTest, EverythingIsZeroWithoutLatencies) {
  const Quantiles none = quantiles(LatencyCounts{});
  EXPECT_EQ(none.count, 0U);
  EXPECT_EQ(none.maximum_ns, 0);
  const LatencyCounts counts = counted({5, 80'000});
  EXPECT_EQ(quantiles(counts.since(counts)).count, 0U);
  EXPECT_EQ(quantiles(counts.since(counts)).maximum_ns, 0);
}

TEST(LatencyHistogramTest, TwoTogetherAreOneOfAllTimes) {
  std::vector<std::int64_t> all = random_times(3000, 1);
  const std::vector<std::int64_t> others = random_times(500, 2);
  LatencyCounts sum = counted(all);
  sum += counted(others);
  all.insert(all.end(), others.begin(), others.end());
  EXPECT_EQ(sum.bins, counted(all).bins);
  EXPECT_EQ(sum.maximum_ns, counted(all).maximum_ns);
}

TEST(LatencyHistogramTest, SinceAnEarlierMomentIsWhatCameAfterIt) {
  LatencyHistogram histogram;
  LatencyCounts earlier;
  for (const std::int64_t time_ns : random_times(3000, 3)) histogram.add(time_ns);
  histogram.add(900'000'000);
  histogram.read(earlier);
  std::vector<std::int64_t> later = random_times(2000, 4);
  for (const std::int64_t time_ns : later) histogram.add(time_ns);
  LatencyCounts now;
  histogram.read(now);
  const Quantiles newer = quantiles(now.since(earlier));
  const Quantiles exact = quantiles(later);
  EXPECT_EQ(newer.count, 2000U);
  expect_near(newer.p99_ns, exact.p99_ns);
  expect_near(newer.maximum_ns, exact.maximum_ns);  // the worst one was before
  histogram.add(950'000'000);
  histogram.read(now);
  EXPECT_EQ(quantiles(now.since(earlier)).maximum_ns, 950'000'000) << "a new worst one is exact";
}

}  // namespace
}  // namespace hapticwall::session
