// The remaining time of the progress bar.
#include "app/command/report/progress.h"

#include <gtest/gtest.h>

namespace hapticwall::command {
namespace {

TEST(Progress, TheRemainingTimeFollowsFromTheWorkOfThisRun) {
  EXPECT_EQ(remaining_s(10.0, 0.0, 0.25), 30.0);
  // Half was there before: a quarter took 10 s, and a quarter is left.
  EXPECT_EQ(remaining_s(10.0, 0.5, 0.75), 10.0);
  EXPECT_EQ(remaining_s(10.0, 0.0, 1.0), 0.0);
  EXPECT_FALSE(remaining_s(10.0, 0.5, 0.505)) << "too little to tell";
}

TEST(Progress, DurationsAreToldInTheUnitsOfPeople) {
  EXPECT_EQ(duration_text(12.4), "12 s");
  EXPECT_EQ(duration_text(200.0), "3 min 20 s");
  EXPECT_EQ(duration_text(7500.0), "2 h 05 min");
}

}  // namespace
}  // namespace hapticwall::command
