#include "app/draw/plot/signal_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>

namespace hapticwall::draw {
namespace {

constexpr std::uint64_t kShapeSamples = 6000;  // samples at 1 kHz
constexpr std::size_t kColumns = 480;          // a window at 6 s
constexpr double kSamplesAColumn = 12.5;

SampleHistory history_of(const std::function<double(double)>& force,
                         std::uint64_t count = kShapeSamples) {
  SampleHistory history(static_cast<std::size_t>(count));
  for (std::uint64_t tick = 0; tick < count; ++tick) {
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) * 1e-3;
    sample.force_n = force(static_cast<double>(tick));
    history.push(sample);
  }
  return history;
}

SignalShape shape_of(const SampleHistory& history, std::size_t columns = kColumns,
                     Quantity quantity = &Sample::force_n, double scale = 1.0) {
  SignalShape shape;
  shape_signal(history, quantity, {0, history.size()}, columns, scale, shape);
  return shape;
}

// A cycle of this many columns, 0 to 9 with a mean of 3.
std::function<double(double)> pulses(double columns) {
  return [=](double tick) {
    return std::fmod((tick + 0.5) / (columns * kSamplesAColumn), 1.0) < 1.0 / 3.0 ? 9.0 : 0.0;
  };
}

TEST(SignalShape, ACycleOfAFewPixelsIsAnEvenBandAndItsMean) {
  for (const double columns : {0.72, 1.6, 4.0, 5.0}) {
    const SignalShape shape = shape_of(history_of(pulses(columns)));
    ASSERT_GE(shape.band.size(), kColumns) << columns;
    EXPECT_EQ(shape.line.value.size(), shape.band.size()) << "the mean is all of the line";
    for (std::size_t i = 4; i + 4 < shape.band.size(); ++i) {
      ASSERT_EQ(shape.band[i].low, 0.0) << columns << " " << i;
      ASSERT_EQ(shape.band[i].high, 9.0) << columns << " " << i;
      ASSERT_NEAR(shape.line.value[i], 3.0, 0.5) << columns << " " << i;
    }
  }
}

TEST(SignalShape, ALongerCycleIsTheLineItself) {
  for (const double columns : {12.0, 40.0, 200.0}) {
    const SampleHistory history = history_of(pulses(columns));
    const SignalShape shape = shape_of(history);
    EXPECT_TRUE(shape.band.empty()) << columns;
    Trace trace;
    history.decimate(&Sample::force_n, {0, history.size()}, kColumns, 1.0, trace);
    EXPECT_EQ(shape.line.value, trace.value);
    EXPECT_EQ(shape.line.time_s, trace.time_s);
  }
}

// Between the two it is one or the other, and not both by turns.
TEST(SignalShape, ACycleOfAMiddleLengthDoesNotAlternate) {
  for (double columns = 5.0; columns < 12.0; columns += 0.37) {
    const SignalShape shape = shape_of(history_of([=](double tick) {
      return std::sin(2.0 * std::numbers::pi * tick / (columns * kSamplesAColumn));
    }));
    int ends = 0;
    for (std::size_t i = 1; i < shape.band.size(); ++i)
      ends += shape.band[i].time_s - shape.band[i - 1].time_s > 0.02 ? 1 : 0;
    EXPECT_EQ(ends, 0) << columns;
  }
}

// A slow press into the wall: the staircase of an encoder is no oscillation, however many steps it
// has in a column.
TEST(SignalShape, AStaircaseAndAStepAreLines) {
  EXPECT_TRUE(
      shape_of(history_of([](double tick) { return std::floor(tick / 7.0); })).band.empty());
  EXPECT_TRUE(
      shape_of(history_of([](double tick) { return tick < 3000 ? 1.0 : 5.0; })).band.empty());
}

TEST(SignalShape, WithRoomForEveryCycleTheSameSignalIsALine) {
  const auto cycle = [](double tick) { return std::fmod(tick, 20.0) < 10.0 ? 9.0 : 0.0; };
  EXPECT_FALSE(shape_of(history_of(cycle)).band.empty());
  EXPECT_TRUE(shape_of(history_of(cycle, 500)).band.empty());
}

// Against brute force: a band holds every sample within half a reach of its column, and no more.
TEST(SignalShape, TheBandHasExactlyTheExtremesOfItsSurroundings) {
  std::mt19937_64 random(7);
  const SampleHistory history = history_of([&](double) {
    return random() % 500 == 0 ? -3.0 : static_cast<double>(random() % 1000) / 250.0;
  });
  const SignalShape shape = shape_of(history);
  ASSERT_GT(shape.band.size(), kColumns);
  for (const BandColumn& column : shape.band) {
    const std::size_t middle = *history.nearest(column.time_s);
    const auto extremes_within = [&](double columns) {
      const auto reach = static_cast<std::size_t>(columns * kSamplesAColumn);
      const std::size_t last = std::min(middle + reach + 1, history.size());
      return history.extremes(&Sample::force_n, {middle - std::min(middle, reach), last});
    };
    const Extremes least = extremes_within(0.5 * kBandReach - 1.0);
    const Extremes most = extremes_within(0.5 * kBandReach + 1.0);
    ASSERT_LE(column.low, least.minimum);
    ASSERT_GE(column.low, most.minimum);
    ASSERT_GE(column.high, least.maximum);
    ASSERT_LE(column.high, most.maximum);
  }
}

TEST(SignalShape, TheMeanLineIsTheMeanOfTheSamples) {
  // Dithers between two counts, more and more in the upper one.
  std::mt19937_64 random(11);
  const SampleHistory history = history_of([&](double tick) {
    return static_cast<double>(random() % kShapeSamples) < tick ? 1.0 : 0.0;
  });
  const SignalShape shape = shape_of(history);
  double error = 0.0;
  for (std::size_t i = 0; i < shape.line.value.size(); ++i)
    error = std::max(error, std::abs(shape.line.value[i] - shape.line.time_s[i] / 6.0));
  EXPECT_LT(error, 0.2);
  EXPECT_GT(shape.band.size(), kColumns / 2);
}

TEST(SignalShape, IsScaledAndHasGapsWhereNothingIsKnown) {
  SampleHistory history(kShapeSamples, 1e-3);
  for (std::uint64_t tick = 0; tick < kShapeSamples; ++tick) {
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) * 1e-3;
    sample.penetration_m = tick / 1000 % 2 == 1 ? 2e-3 : -1e-3;
    sample.force_n = 4.0;
    history.push(sample);
  }
  const SignalShape shape = shape_of(history, kColumns, Derived::kStiffness, 1e-3);
  for (std::size_t i = 0; i < shape.line.value.size(); ++i) {
    // It reaches as far as the running quotient remembers a contact.
    const double within_s = std::fmod(shape.line.time_s[i], 2.0);
    const bool known = within_s > 1.02 || (within_s < 0.08 && shape.line.time_s[i] > 1.0);
    const bool unknown = within_s < 0.98 && within_s > 0.12;
    if (known) ASSERT_NEAR(shape.line.value[i], 2.0, 1e-12) << shape.line.time_s[i];
    if (unknown) ASSERT_TRUE(std::isnan(shape.line.value[i])) << shape.line.time_s[i];
  }
  EXPECT_TRUE(shape.band.empty());
}

TEST(SignalShape, OfFewSamplesHasThemAll) {
  for (const std::uint64_t count : {1U, 2U, 3U, 5U}) {
    const SignalShape shape = shape_of(history_of([](double tick) { return tick; }, count));
    EXPECT_EQ(shape.line.value.size(), count);
    EXPECT_TRUE(shape.band.empty());
  }
}

}  // namespace
}  // namespace hapticwall::draw
