#include "app/runtime/loop/spinning_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/app/runtime/support.h"

namespace hapticwall::runtime {
namespace {

using test::FakeClock;

// Every look at it takes 3 ns.
class TickingClock : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() override { return now_ns_ += 3; }
  void sleep_until_ns(std::int64_t deadline_ns) override {
    slept_until.push_back(deadline_ns);
    now_ns_ = std::max(now_ns_, deadline_ns + overslept_ns);
  }
  std::vector<std::int64_t> slept_until;
  std::int64_t overslept_ns = 0;

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

TEST(SpinningClock, LeavesATenthOfThePeriodToOthers) {
  EXPECT_EQ(spin_ns(100e-6, 1000.0), 100'000);
  EXPECT_EQ(spin_ns(5e-3, 1000.0), 900'000);
  EXPECT_EQ(spin_ns(0.0, 1000.0), 0);
}

}  // namespace
}  // namespace hapticwall::runtime
