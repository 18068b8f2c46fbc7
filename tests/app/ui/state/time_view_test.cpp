#include "app/ui/state/time_view.h"

#include <gtest/gtest.h>

namespace hapticwall::ui {
namespace {

TEST(TimeView, ShowsAboutTenPeriodsOfAnOscillation) {
  TimeView time;
  EXPECT_EQ(window_length_s(time), 6.0);
  for (const double frequency_hz : {2.5, 8.8, 17.0, 50.0, 120.0}) {
    follow_rhythm(time, std::nullopt);
    follow_rhythm(time, frequency_hz);
    const double periods = window_length_s(time) * frequency_hz;
    EXPECT_GE(periods, 8.0) << frequency_hz;
    EXPECT_LE(periods, 25.0) << frequency_hz;
  }
  follow_rhythm(time, std::nullopt);
  EXPECT_EQ(window_length_s(time), 6.0);
}

TEST(TimeView, KeepsItsLengthWhileTheFrequencyVariesALittle) {
  TimeView time;
  follow_rhythm(time, 50.0);
  const double length_s = window_length_s(time);
  for (const double frequency_hz : {45.0, 60.0, 35.0, 70.0, 50.0}) {
    follow_rhythm(time, frequency_hz);
    EXPECT_EQ(window_length_s(time), length_s) << frequency_hz;
  }
  follow_rhythm(time, 8.8);
  EXPECT_GT(window_length_s(time), length_s);
}

TEST(TimeView, AChosenLengthIsTheLongestAndMayBeTheOnlyOne) {
  TimeView time;
  time.window_s = 0.1;
  follow_rhythm(time, 50.0);
  EXPECT_EQ(window_length_s(time), 0.1);
  time.window_s = 10.0;
  time.follows_rhythm = false;
  EXPECT_EQ(window_length_s(time), 10.0);
  follow_newest(time, 25.0);
  EXPECT_EQ(time.from_s, 15.0);
  EXPECT_EQ(time.to_s, 25.0);
}

}  // namespace
}  // namespace hapticwall::ui
