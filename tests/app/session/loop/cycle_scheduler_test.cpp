#include "app/session/loop/cycle_scheduler.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace hapticwall::session {
namespace {

constexpr std::int64_t kStartNs = 123'456'789;
constexpr std::int64_t kTenSecondsNs = 10'000'000'000;
constexpr std::int64_t kHourNs = 3'600'000'000'000;

class RateTest : public ::testing::TestWithParam<int> {};

// Every cycle of the first and of the last ten seconds; one late wake-up passes over the rest.
TEST_P(RateTest, PhaseAfterAnHourIsExact) {
  const std::int64_t rate_hz = GetParam();
  CycleScheduler scheduler(static_cast<double>(rate_hz), kStartNs);
  const std::int64_t period_ns = 1'000'000'000 / rate_hz;
  std::int64_t previous_ns = kStartNs;
  const auto run_until = [&](std::int64_t end_ns) {
    while (previous_ns < end_ns) {
      const std::int64_t deadline_ns = scheduler.deadline_ns();
      const std::int64_t step_ns = deadline_ns - previous_ns;
      ASSERT_TRUE(step_ns == period_ns || step_ns == period_ns + 1) << previous_ns;
      const Wake wake = scheduler.wake(deadline_ns);
      ASSERT_EQ(wake.latency_ns, 0);
      ASSERT_EQ(wake.missed, 0U) << previous_ns;
      previous_ns = deadline_ns;
    }
    EXPECT_EQ(previous_ns, end_ns);
  };
  run_until(kStartNs + kTenSecondsNs);
  const std::int64_t late_ns = kStartNs + kHourNs - kTenSecondsNs;
  EXPECT_EQ(scheduler.wake(late_ns).missed, static_cast<std::uint64_t>(3580 * rate_hz - 1));
  previous_ns = late_ns;
  run_until(kStartNs + kHourNs);
}

INSTANTIATE_TEST_SUITE_P(Rates, RateTest, ::testing::Values(100, 333, 1000, 3000, 7001, 10000));

TEST(CycleScheduler, DeadlinesAreRoundedAndNotCut) {
  CycleScheduler scheduler(3000.0, 0);
  EXPECT_EQ(scheduler.deadline_ns(), 333'333);
  scheduler.wake(scheduler.deadline_ns());
  EXPECT_EQ(scheduler.deadline_ns(), 666'667);
  scheduler.wake(scheduler.deadline_ns());
  EXPECT_EQ(scheduler.deadline_ns(), 1'000'000);
}

TEST(CycleScheduler, LatenessWithinThePeriodMissesNothing) {
  CycleScheduler scheduler(1000.0, 0);
  const Wake wake = scheduler.wake(1'999'999);
  EXPECT_EQ(wake.now_ns, 1'999'999);
  EXPECT_EQ(wake.latency_ns, 999'999);
  EXPECT_EQ(wake.missed, 0U);
  EXPECT_EQ(scheduler.deadline_ns(), 2'000'000);
}

TEST(CycleScheduler, OverrunKeepsThePhaseAndCountsWithoutABurst) {
  CycleScheduler scheduler(1000.0, 0);
  const Wake late = scheduler.wake(17'300'000);  // waited for 1 ms; 2 to 17 ms have passed
  EXPECT_EQ(late.latency_ns, 16'300'000);
  EXPECT_EQ(late.missed, 16U);
  EXPECT_EQ(scheduler.deadline_ns(), 18'000'000);
  const Wake next = scheduler.wake(18'000'050);
  EXPECT_EQ(next.latency_ns, 50);
  EXPECT_EQ(next.missed, 0U);
}

TEST(CycleScheduler, WakingExactlyOnALaterDeadlineIsThatDeadlinesCycle) {
  CycleScheduler scheduler(1000.0, 0);
  const Wake wake = scheduler.wake(3'000'000);
  EXPECT_EQ(wake.missed, 2U);
  EXPECT_EQ(scheduler.deadline_ns(), 4'000'000);
}

// Cycles and missed deadlines add up to all deadlines, for holes of any length.
TEST(CycleScheduler, NothingIsCountedTwiceOrForgotten) {
  for (const double rate_hz : {100.0, 1000.0, 3000.0, 9999.0}) {
    CycleScheduler scheduler(rate_hz, kStartNs);
    std::uint64_t deadlines = 0;
    std::int64_t now_ns = kStartNs;
    std::uint64_t noise = 12345;
    for (int i = 0; i < 20'000; ++i) {
      noise = noise * 6364136223846793005ULL + 1442695040888963407ULL;
      const auto hole_ns = static_cast<std::int64_t>((noise >> 33U) % 5'000'000U);
      now_ns = std::max(now_ns + hole_ns, scheduler.deadline_ns());
      deadlines += 1 + scheduler.wake(now_ns).missed;
      ASSERT_GT(scheduler.deadline_ns(), now_ns);
    }
    const auto expected = static_cast<std::uint64_t>(
        static_cast<double>(now_ns - kStartNs) * rate_hz / kNanosecondsPerSecond + 1e-3);
    EXPECT_EQ(deadlines, expected) << rate_hz;
  }
}

TEST(CycleScheduler, AHoleOfADayIsCountedAtOnce) {
  CycleScheduler scheduler(10000.0, 0);
  const Wake wake = scheduler.wake(24 * kHourNs);
  EXPECT_EQ(wake.missed, 24ULL * 3600 * 10000 - 1);
  EXPECT_EQ(scheduler.deadline_ns(), 24 * kHourNs + 100'000);
}

}  // namespace
}  // namespace hapticwall::session
