// A plug-in whose step takes longer than a tick, on a device and a clock of the test.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "tests/app/session/loop/loop_bench.h"
#include "tests/plugins/loaded/loaded_plugins.h"

namespace hapticwall::session {
namespace {

using test::FakeClock;
using test::FakeDevice;

constexpr int kArmedTicks = 510;
constexpr int kSlowAt = kArmedTicks + 10;

class SlowPlugin : public ::testing::Test {
 protected:
  // One step of this length on an armed device in contact, then 20 cycles more.
  void take(std::int64_t step_ns) {
    bench_.device.position_m = 0.03;
    bench_.command(CommandKind::kArm);
    bench_.clock.after_sleep = [this, step_ns, cycle = 0](FakeClock& /*now*/) mutable {
      if (cycle == kArmedTicks) bench_.device.position_m = 0.051;
      if (cycle == kSlowAt) slow_ns_ = step_ns;
      if (++cycle == kSlowAt + 20) bench_.exchange.stop = true;
    };
    hapticwall::test::in_each_step() = [this] {
      bench_.clock.advance_ns(std::exchange(slow_ns_, 0));
    };
    run_servo_loop(bench_.loop, bench_.exchange, 1000.0, bench_.clock);
    hapticwall::test::in_each_step() = nullptr;
  }

  test::LoopBench<FakeDevice> bench_{
      test::with_algorithm(test::contact_scene(), hapticwall::test::hooked_plugin())};
  std::int64_t slow_ns_ = 0;
};

TEST_F(SlowPlugin, OfFiveMillisecondsIsCountedAndKeepsItsForce) {
  take(5'000'000);
  const Snapshot end = bench_.snapshot();
  EXPECT_EQ(end.timing.missed_ticks, 4U);
  EXPECT_NE(end.arming.note, ArmingNote::kLate);
  const std::size_t last = bench_.device.forces_n.size() - 2;  // the loop ends with no force
  EXPECT_GT(bench_.device.forces_n.at(last), 0.0);
  EXPECT_TRUE(bench_.device.enabled_at_write.at(last));
}

TEST_F(SlowPlugin, OfMoreThanTwentyMillisecondsDisarms) {
  take(22'000'000);
  const Snapshot end = bench_.snapshot();
  EXPECT_EQ(end.timing.missed_ticks, 21U);
  EXPECT_EQ(end.arming.note, ArmingNote::kLate);
  EXPECT_GT(bench_.device.forces_n.at(kSlowAt - 1), 0.0);
  for (std::size_t i = kSlowAt + 1; i < bench_.device.forces_n.size(); ++i)
    EXPECT_EQ(bench_.device.forces_n[i], 0.0) << i;
}

}  // namespace
}  // namespace hapticwall::session
