#include "app/draw/plot/plot_cursors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace hapticwall::draw {
namespace {

constexpr std::array kPlots{PlotId::kPosition, PlotId::kForce};

SampleHistory ramp() {
  SampleHistory history(1000);
  for (std::uint64_t tick = 0; tick < 1000; ++tick) {
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) * 1e-3;
    sample.position_m = 2e-3 * static_cast<double>(tick);
    sample.velocity_m_per_s = 2.0;
    sample.force_n = -3.0 * static_cast<double>(tick);
    history.push(sample);
  }
  return history;
}

TEST(Cursors, ReadAllLinesThatAreShownInTheUnitsOfTheirPlots) {
  const SampleHistory history = ramp();
  ChosenLines chosen = usual_lines();
  chosen[static_cast<std::size_t>(PlotId::kPosition)] =
      line_bit(&Sample::position_m) | line_bit(&Sample::velocity_m_per_s);
  const CursorTable table = read_cursors(history, {true, {0.1004, 0.3496}}, kPlots, chosen,
                                         line_bit(&Sample::wall_force_n));
  EXPECT_DOUBLE_EQ(table.time_s[0], 0.100);  // time of the nearest sample
  EXPECT_DOUBLE_EQ(table.time_s[1], 0.350);
  EXPECT_NEAR(table.difference_s(), 0.25, 1e-12);
  ASSERT_TRUE(table.rate_hz().has_value());
  EXPECT_NEAR(*table.rate_hz(), 4.0, 1e-9);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].line->quantity, Quantity(&Sample::position_m));
  EXPECT_STREQ(table.rows[0].unit, "mm");
  EXPECT_NEAR(table.rows[0].value[0], 200.0, 1e-9);
  EXPECT_NEAR(table.rows[0].value[1], 700.0, 1e-9);
  EXPECT_NEAR(table.rows[0].difference(), 500.0, 1e-9);
  EXPECT_EQ(table.rows[1].line->quantity, Quantity(&Sample::velocity_m_per_s));
  EXPECT_STREQ(table.rows[1].unit, "mm/s");
  EXPECT_NEAR(table.rows[1].value[0], 2000.0, 1e-9);
  EXPECT_EQ(table.rows[2].line->quantity, Quantity(&Sample::force_n));
  EXPECT_NEAR(table.rows[2].difference(), -750.0, 1e-9);
}

// Against sums over the samples, near and far apart, in either order of the cursors.
TEST(Cursors, StatisticsAreThoseOfTheSamplesBetweenThem) {
  constexpr std::size_t kSamples = 9000;
  SampleHistory history(kSamples);
  for (std::uint64_t tick = 0; tick < kSamples; ++tick) {
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) * 1e-3;
    sample.force_n = 50.0 + std::sin(0.37 * static_cast<double>(tick));
    sample.energy_scv_j = 1e-4 * static_cast<double>(tick);
    history.push(sample);
  }
  ChosenLines chosen{};
  chosen[static_cast<std::size_t>(PlotId::kForce)] = line_bit(&Sample::force_n);
  for (const auto& [from, to] :
       {std::pair(10U, 40U), std::pair(5U, 8900U), std::pair(7000U, 990U)}) {
    const CursorTable table = read_cursors(
        history, {true, {static_cast<double>(from) * 1e-3, static_cast<double>(to) * 1e-3}}, kPlots,
        chosen, 0);
    const auto [first, last] = std::minmax(from, to);
    double sum = 0.0;
    double squares = 0.0;
    for (unsigned i = first; i <= last; ++i) {
      const double value = history.value(&Sample::force_n, i);
      sum += value;
      squares += value * value;
    }
    const double count = last - first + 1;
    ASSERT_EQ(table.rows.size(), 1U);
    const CursorRow& row = table.rows.front();
    EXPECT_NEAR(row.mean, sum / count, 1e-9);
    EXPECT_NEAR(row.rms, std::sqrt(squares / count), 1e-9);
    EXPECT_NEAR(row.deviation, std::sqrt(squares / count - sum * sum / count / count), 1e-7);
    EXPECT_NEAR(row.peak_to_peak, 2.0, 0.05);
    EXPECT_NEAR(table.energy_j, 1e-4 * (static_cast<double>(to) - static_cast<double>(from)), 1e-9);
  }
}

TEST(Cursors, OfASignalThatIsUnknownThereIsNoStatistic) {
  ChosenLines chosen{};
  chosen[static_cast<std::size_t>(PlotId::kStiffness)] = line_bit(Derived::kStiffness);
  const CursorTable table =
      read_cursors(ramp(), {true, {0.1, 0.3}}, std::array{PlotId::kStiffness}, chosen, 0);
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_TRUE(std::isnan(table.rows.front().mean));
  EXPECT_TRUE(std::isnan(table.rows.front().deviation));
  EXPECT_TRUE(std::isnan(table.rows.front().peak_to_peak));
}

TEST(Cursors, OnADeviceTheTruthIsNoRow) {
  ChosenLines chosen{};
  chosen[0] = line_bit(&Sample::position_m) | line_bit(&PlantTruth::position_m);
  EXPECT_EQ(read_cursors(ramp(), {true, {0.1, 0.3}}, kPlots, chosen, 0, true).rows.size(), 2U);
  EXPECT_EQ(read_cursors(ramp(), {true, {0.1, 0.3}}, kPlots, chosen, 0, false).rows.size(), 1U);
}

TEST(Cursors, AtTheSameSampleThereIsNoRate) {
  const CursorTable table = read_cursors(ramp(), {true, {0.2, 0.2001}}, kPlots, usual_lines(), 0);
  EXPECT_DOUBLE_EQ(table.difference_s(), 0.0);
  EXPECT_FALSE(table.rate_hz().has_value());
}

TEST(Cursors, TheRateIsPositiveWhicheverComesFirst) {
  const CursorTable table = read_cursors(ramp(), {true, {0.6, 0.1}}, kPlots, usual_lines(), 0);
  EXPECT_NEAR(table.difference_s(), -0.5, 1e-12);
  EXPECT_NEAR(*table.rate_hz(), 2.0, 1e-9);
}

TEST(Cursors, NoSamplesGiveNoRows) {
  const CursorTable table =
      read_cursors(SampleHistory(10), {true, {0.6, 0.1}}, kPlots, usual_lines(), 0);
  EXPECT_TRUE(table.rows.empty());
  EXPECT_FALSE(table.rate_hz().has_value());
}

TEST(Cursors, StandWhereTheyAreOnTheScreenWhileTheWindowMoves) {
  Cursors cursors;
  place_cursors(cursors, {3.0, 6.0});
  EXPECT_DOUBLE_EQ(cursors.time_s[0], 4.0);
  EXPECT_DOUBLE_EQ(cursors.time_s[1], 5.0);
  carry_cursors(cursors, {3.0, 6.0}, {13.0, 16.0});
  EXPECT_DOUBLE_EQ(cursors.time_s[0], 14.0);
  carry_cursors(cursors, {13.0, 16.0}, {0.0, 30.0});
  EXPECT_DOUBLE_EQ(cursors.time_s[0], 10.0);
  EXPECT_DOUBLE_EQ(cursors.time_s[1], 20.0);
  carry_cursors(cursors, {0.0, 0.0}, {1.0, 2.0});  // there was no window yet
  EXPECT_DOUBLE_EQ(cursors.time_s[0], 10.0);
}

}  // namespace
}  // namespace hapticwall::draw
