#include "app/session/loop/spinning_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "app/session/loop/cycle_scheduler.h"
#include "app/session/loop/realtime_setup.h"
#include "tests/app/session/support.h"

namespace hapticwall::session {
namespace {

using test::FakeClock;

class TickingClock : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() override { return now_ns_ += look_ns; }
  void sleep_until_ns(std::int64_t deadline_ns) override {
    slept_until.push_back(deadline_ns);
    now_ns_ = std::max(now_ns_, deadline_ns + overslept_ns);
  }
  std::vector<std::int64_t> slept_until;
  void work_ns(std::int64_t duration_ns) { now_ns_ += duration_ns; }
  std::int64_t overslept_ns = 0;
  std::int64_t look_ns = 3;  // duration of every look at it

 private:
  std::int64_t now_ns_ = 0;
};

TEST(SpinningClock, SleepsShortAndWaitsOutTheRest) {
  TickingClock inner;
  SpinningClock clock(inner, 100);
  clock.sleep_until_ns(1000);
  EXPECT_EQ(inner.slept_until, std::vector<std::int64_t>{900});
  const std::int64_t now = clock.now_ns();
  EXPECT_GE(now, 1000);
  EXPECT_LE(now, 1009) << "not a moment longer";
}

TEST(SpinningClock, WhoWokeUpLateDoesNotWait) {
  TickingClock inner;
  inner.overslept_ns = 500;
  SpinningClock clock(inner, 100);
  clock.sleep_until_ns(1000);
  EXPECT_EQ(clock.now_ns(), 900 + 500 + 6) << "one look, then this one";
}

TEST(SpinningClock, WithoutSpinningItIsTheOtherClock) {
  FakeClock inner;
  SpinningClock clock(inner, 0);
  const std::int64_t deadline = inner.now_ns() + 5000;
  clock.sleep_until_ns(deadline);
  EXPECT_EQ(clock.now_ns(), deadline);
}

// Ticks that leave less than the spin, and ticks that are longer than a period.
TEST(SpinningClock, SleepsAnInstantTwiceASecondIfItsPeriodsAreFull) {
  constexpr std::int64_t kPeriodNs = 1'000'000;
  for (const std::int64_t tick_ns : {150'000, 1'700'000}) {
    TickingClock inner;
    inner.look_ns = 1000;
    SpinningClock clock(inner, 900'000);
    CycleScheduler scheduler(1000.0, 0);
    std::int64_t now_ns = 0;
    while (now_ns < 2'200'000'000) {
      clock.sleep_until_ns(scheduler.deadline_ns());
      now_ns = clock.now_ns();
      static_cast<void>(scheduler.wake(now_ns));
      inner.work_ns(tick_ns);
    }
    EXPECT_GE(inner.slept_until.size(), 4U) << tick_ns;
    EXPECT_LE(inner.slept_until.size(), 5U) << tick_ns;
    static_assert(kMaxAwakeNs + 2 * kPeriodNs < 1000 * static_cast<std::int64_t>(kMaxAwakeUs));
  }
}

TEST(SpinningClock, LeavesATenthOfThePeriodToOthers) {
  EXPECT_EQ(spin_ns(100e-6, 1000.0), 100'000);
  EXPECT_EQ(spin_ns(5e-3, 1000.0), 900'000);
  EXPECT_EQ(spin_ns(0.0, 1000.0), 0);
}

}  // namespace
}  // namespace hapticwall::session
