#include "app/draw/plot/plot_cursors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

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
  EXPECT_DOUBLE_EQ(table.time_s[0], 0.100);  // of the nearest samples
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
