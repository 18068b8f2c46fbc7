#include "app/session/loop/clock_judge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hapticwall::session {
namespace {

// A report a millisecond, for so long. The first objection.
ArmingNote after(ClockJudge& judge, double seconds, double rate, double jitter_s = 0.0) {
  for (int tick = 0; tick < static_cast<int>(1e3 * seconds); ++tick) {
    const double host_s = 1e-3 * tick;
    const double late_s = jitter_s * (0.5 + 0.5 * std::sin(1.7 * tick));
    const ArmingNote note = judge.hear(rate * host_s, host_s + late_s);
    if (note != ArmingNote::kNone) return note;
  }
  return ArmingNote::kNone;
}

TEST(ClockJudge, ComparesPeriodsOfATenthOfASecond) {
  for (const double rate : {0.1, 0.9, 0.94, 1.06, 1.1, 5.0}) {
    ClockJudge judge;
    EXPECT_EQ(after(judge, 0.1, rate), ArmingNote::kNone);
    EXPECT_FALSE(judge.known());
    judge.forget();
    EXPECT_EQ(after(judge, 0.12, rate), ArmingNote::kClockRate) << rate;
  }
}

TEST(ClockJudge, AClockThatIsALittleWrongAndReportsThatAreLateAreNoObjection) {
  for (const double rate : {0.97, 0.99, 1.0, 1.01, 1.03}) {
    ClockJudge judge;
    EXPECT_EQ(after(judge, 10.0, rate, std::abs(rate - 1.0) < 0.02 ? 2e-3 : 0.5e-3),
              ArmingNote::kNone)
        << rate;
    EXPECT_TRUE(judge.known());
  }
}

TEST(ClockJudge, TicksThatAreMissedAndAHostThatStandsStillAreNoObjection) {
  ClockJudge judge;
  double host_s = 0.0;
  for (int i = 0; i < 2000; ++i) {
    host_s += i % 50 == 0 ? 15e-3 : 1e-3;
    ASSERT_EQ(judge.hear(host_s, host_s), ArmingNote::kNone) << i;
  }
}

TEST(ClockJudge, AJumpIsNamedAndTheNewTimeCounts) {
  for (const double jump_s : {0.03, 0.5, -0.03, -3.0}) {
    ClockJudge judge;
    EXPECT_EQ(after(judge, 1.0, 1.0), ArmingNote::kNone);
    EXPECT_EQ(judge.hear(1.0 + jump_s, 1.0), ArmingNote::kClockJump);
    EXPECT_FALSE(judge.known());
    for (int tick = 1; tick < 300; ++tick) {
      EXPECT_EQ(judge.hear(1.0 + jump_s + 1e-3 * tick, 1.0 + 1e-3 * tick), ArmingNote::kNone);
    }
    EXPECT_TRUE(judge.known());
  }
}

TEST(ClockJudge, ASilentDeviceKeepsItsVerdict) {
  ClockJudge judge;
  EXPECT_EQ(after(judge, 0.2, 0.5), ArmingNote::kClockRate);
  EXPECT_EQ(judge.hear(0.0505, 0.101), ArmingNote::kClockRate);
  EXPECT_EQ(judge.hear(0.0505, 0.119), ArmingNote::kClockRate);  // the same report again
}

}  // namespace
}  // namespace hapticwall::session
