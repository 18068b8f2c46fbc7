#include "app/draw/plot/sample_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

namespace hapticwall::draw {
namespace {

constexpr std::uint64_t kSeed = 20240607;

// A walk with rare spikes: extremes far from their neighbours, and long flat pieces.
std::vector<double> walk(std::size_t count) {
  std::mt19937_64 random(kSeed);
  std::vector<double> values;
  double value = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t dice = random() % 1000;
    if (i / 3000 % 3 != 1) value += static_cast<double>(dice) / 1000.0 - 0.5;
    values.push_back(dice == 0 ? value + 100.0 : value);
  }
  return values;
}

SamplePyramid pyramid_of(const std::vector<double>& values) {
  SamplePyramid pyramid;
  for (const double value : values) pyramid.push_back(value);
  return pyramid;
}

// Precondition: `pyramid` has the samples from `first` to `last` (exclusive) of `values`.
void expect_exact(const SamplePyramid& pyramid, const std::vector<double>& values,
                  std::uint64_t first, std::uint64_t last) {
  const auto [low, high] = std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(first),
                                               values.begin() + static_cast<std::ptrdiff_t>(last));
  const SampleStats stats = pyramid.stats(first, last);
  ASSERT_EQ(stats.extremes.minimum, *low) << first << " to " << last;
  ASSERT_EQ(stats.extremes.maximum, *high) << first << " to " << last;
  ASSERT_EQ(stats.count, static_cast<double>(last - first));
  const double sum = std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(first),
                                     values.begin() + static_cast<std::ptrdiff_t>(last), 0.0);
  ASSERT_NEAR(stats.sum, sum, 1e-9 * stats.count * std::max(std::abs(*low), std::abs(*high)));
}

TEST(BlockArray, GivesBackWhatWasPushedWhereverBlocksAreFlat) {
  BlockArray<double> array;
  const auto value = [](std::uint64_t i) {
    return i / 1500 % 2 == 0 ? 7.0 : static_cast<double>(i);
  };
  for (std::uint64_t i = 0; i < 10000; ++i) array.push_back(value(i));
  ASSERT_EQ(array.end(), 10000U);
  for (std::uint64_t i = 0; i < 10000; ++i) ASSERT_EQ(array[i], value(i)) << i;
}

TEST(BlockArray, TellsMinusZeroFromZero) {
  BlockArray<double> array;
  array.push_back(0.0);
  array.push_back(-0.0);
  EXPECT_FALSE(std::signbit(array[0]));
  EXPECT_TRUE(std::signbit(array[1]));
}

TEST(BlockArray, ForgetsWholeBlocksAndKeepsTheIndicesOfTheRest) {
  constexpr std::uint64_t kBlock = BlockArray<double>::kBlock;
  BlockArray<double> array;
  for (std::uint64_t i = 0; i < 5 * kBlock; ++i) array.push_back(static_cast<double>(i));
  array.forget_before(2 * kBlock + 17);
  EXPECT_EQ(array.first(), 2 * kBlock);
  for (std::uint64_t i = array.first(); i < array.end(); ++i)
    ASSERT_EQ(array[i], static_cast<double>(i));
  array.forget_before(2 * kBlock - 1);  // nothing comes back, nothing else goes
  EXPECT_EQ(array.first(), 2 * kBlock);
  array.forget_before(100 * kBlock);
  EXPECT_EQ(array.first(), array.end());
  array.push_back(1.5);
  EXPECT_EQ(array[5 * kBlock], 1.5);
}

TEST(BlockArray, ACopyStaysAsItWas) {
  BlockArray<double> array;
  for (int i = 0; i < 1500; ++i) array.push_back(i);
  const BlockArray<double> copy = array;
  for (int i = 1500; i < 5000; ++i) array.push_back(-i);
  array.forget_before(3000);
  ASSERT_EQ(copy.first(), 0U);
  ASSERT_EQ(copy.end(), 1500U);
  for (std::uint64_t i = 0; i < 1500; ++i) ASSERT_EQ(copy[i], static_cast<double>(i));
}

// Against brute force, over random ranges, at every stage of growth.
TEST(SamplePyramid, ExtremesAreExactlyThoseOfTheSamples) {
  const std::vector<double> values = walk(70000);
  std::mt19937_64 random(kSeed + 1);
  SamplePyramid pyramid;
  for (std::size_t i = 0; i < values.size(); ++i) {
    pyramid.push_back(values[i]);
    if (i % 97 != 0) continue;
    const std::uint64_t a = random() % (i + 1);
    const std::uint64_t b = random() % (i + 1);
    ASSERT_NO_FATAL_FAILURE(expect_exact(pyramid, values, std::min(a, b), std::max(a, b) + 1));
  }
}

TEST(SamplePyramid, ExtremesStayRightWhenTheOldestIsForgotten) {
  const std::vector<double> values = walk(60000);
  SamplePyramid pyramid;
  std::mt19937_64 random(kSeed + 2);
  for (std::size_t i = 0; i < values.size(); ++i) {
    pyramid.push_back(values[i]);
    if (i > 9000 && i % 501 == 0) pyramid.forget_before(i - 9000);
    if (i % 211 != 0) continue;
    const std::uint64_t count = pyramid.end() - pyramid.first();
    const std::uint64_t first = pyramid.first() + random() % count;
    const std::uint64_t last = first + 1 + random() % (pyramid.end() - first);
    ASSERT_NO_FATAL_FAILURE(expect_exact(pyramid, values, first, last));
  }
  EXPECT_GE(pyramid.first(), 40000U);
}

// The number of parts is the cost of a look at a range: it does not grow with the range.
TEST(SamplePyramid, AnyRangeOfAnHourIsAFewParts) {
  constexpr std::uint64_t kHour = 3'600'000;
  constexpr std::uint64_t kMaxParts = 120;
  SamplePyramid pyramid;
  for (std::uint64_t i = 0; i < kHour; ++i) pyramid.push_back(static_cast<double>(i % 1013));
  std::mt19937_64 random(kSeed + 3);
  for (int trial = 0; trial < 2000; ++trial) {
    const std::uint64_t first = random() % kHour;
    const std::uint64_t last = first + 1 + random() % (kHour - first);
    std::uint64_t parts = 0;
    pyramid.visit_parts(
        first, last, [&](const SampleStats&) { ++parts; }, [&](double) { ++parts; });
    ASSERT_LE(parts, kMaxParts) << first << " to " << last;
  }
}

TEST(SamplePyramid, MaskedSamplesHaveNoPartInExtremesAndMean) {
  SamplePyramid pyramid;
  for (int i = 0; i < 5000; ++i)
    pyramid.push_back(i % 3 == 0 || i / 1000 == 2 ? kMasked : static_cast<double>(i % 3));
  const SampleStats all = pyramid.stats(0, 5000);
  EXPECT_EQ(all.extremes.minimum, 1.0);
  EXPECT_EQ(all.extremes.maximum, 2.0);
  EXPECT_NEAR(all.mean(), 1.5, 1e-3);
  EXPECT_TRUE(pyramid.stats(2000, 3000).empty());
  EXPECT_TRUE(pyramid.stats(3, 4).empty());
}

TEST(SamplePyramid, FindsTheNewestSampleAboveAThreshold) {
  const std::vector<double> values = walk(30000);
  const SamplePyramid pyramid = pyramid_of(values);
  std::mt19937_64 random(kSeed + 4);
  int found = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const std::uint64_t first = random() % values.size();
    const std::uint64_t last = first + random() % (values.size() - first + 1);
    const double threshold = values[random() % values.size()] + (trial % 3 == 0 ? 90.0 : 0.0);
    std::optional<std::uint64_t> above;
    std::optional<std::uint64_t> not_above;
    for (std::uint64_t i = first; i < last; ++i) (values[i] > threshold ? above : not_above) = i;
    ASSERT_EQ(pyramid.newest_above(first, last, threshold), above);
    ASSERT_EQ(pyramid.newest_not_above(first, last, threshold), not_above);
    if (above) ++found;
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(found, 1900);
}

}  // namespace
}  // namespace hapticwall::draw
