// The thread's body without a thread, on a recording device and a controlled clock.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>

#include "device/simulated_device.h"
#include "tests/app/session/loop/loop_bench.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;
using test::FakeClock;
using test::FakeDevice;
using test::LoopBench;

constexpr int kTicksUntilArmed = 510;  // the ramp is over
constexpr double kBodyFreeM = 0.03;
constexpr double kBodyInsideM = 0.051;

struct BodyHarness : LoopBench<FakeDevice> {
  BodyHarness() : LoopBench(contact_scene()) { device.position_m = kBodyInsideM; }

  // Runs the body until it has slept `cycles` times, or ended by itself.
  void run(int cycles) {
    clock.after_sleep = [this, cycles, slept = 0](FakeClock& now) mutable {
      if (lateness_ns) now.advance_ns(lateness_ns(slept));
      if (++slept == cycles) exchange.stop = true;
    };
    run_servo_loop(loop, exchange, scene.sampling.rate_hz, clock);
  }
  // Outside the wall until the force is on, then inside it.
  void arm_and_press() {
    command(CommandKind::kArm);
    lateness_ns = [this](int cycle) {
      device.position_m = cycle <= kTicksUntilArmed ? kBodyFreeM : kBodyInsideM;
      return 0;
    };
  }
  void expect_safe_end() const {
    EXPECT_TRUE(exchange.finished);
    ASSERT_FALSE(device.log.empty());
    EXPECT_EQ(device.log.back(), "close");
    ASSERT_FALSE(device.forces_n.empty());
    EXPECT_EQ(device.forces_n.back(), 0.0);
  }

  std::function<std::int64_t(int)> lateness_ns;
};

TEST(ServoLoopBody, EndsWithZeroForceAndAClosedDevice) {
  BodyHarness harness;
  harness.arm_and_press();
  harness.run(kTicksUntilArmed + 50);
  ASSERT_EQ(harness.device.forces_n.size(), kTicksUntilArmed + 51U);
  EXPECT_GT(harness.device.forces_n[kTicksUntilArmed + 49], 0.0);
  harness.expect_safe_end();
  EXPECT_FALSE(harness.snapshot().ended_by_fault);
}

TEST(ServoLoopBody, ADeviceThatThrowsEndsItSafelyAndVisibly) {
  BodyHarness harness;
  harness.device.throw_at_read = 20;
  harness.run(1'000'000);
  EXPECT_EQ(harness.device.reads, 20);
  harness.expect_safe_end();
  EXPECT_TRUE(harness.snapshot().ended_by_fault);
  EXPECT_NE(harness.snapshot().newest.x().flags & kFlagDeviceFault, 0U);
  EXPECT_EQ(harness.snapshot().newest.x().force_n, 0.0);
}

TEST(ServoLoopBody, ADeviceThatCannotEvenBeZeroedIsStillClosed) {
  BodyHarness harness;
  harness.device.throw_at_write = true;
  harness.run(1'000'000);
  EXPECT_EQ(harness.device.log.back(), "close");
  EXPECT_TRUE(harness.exchange.finished);
  EXPECT_TRUE(harness.snapshot().ended_by_fault);
}

TEST(ServoLoopBody, HolesAreCountedAndNotCaughtUp) {
  BodyHarness harness;
  harness.lateness_ns = [](int cycle) { return cycle == 10 ? 4'500'000 : 20'000; };
  const std::int64_t start_ns = harness.clock.now_ns();
  harness.run(100);
  const TimingStatistics timing = harness.snapshot().timing;
  EXPECT_EQ(timing.ticks, 100U);
  EXPECT_EQ(timing.missed_ticks, 4U);
  EXPECT_DOUBLE_EQ(timing.maximum_wake_latency_s, 4.5e-3);
  EXPECT_DOUBLE_EQ(timing.wake_latency_s, 20e-6);
  LatencyCounts latencies;
  harness.exchange.wake_latency.read(latencies);
  EXPECT_EQ(latencies.total(), 100U);
  EXPECT_EQ(latencies.maximum_ns, 4'500'000);
  EXPECT_EQ(latencies.bins[LatencyBins::of(20'000)], 99U);
  EXPECT_EQ(harness.clock.now_ns() - start_ns, 104'000'000 + 20'000) << "the phase is kept";
}

TEST(ServoLoopBody, ARealDeviceKnowsNoSlowMotion) {
  BodyHarness harness;
  harness.command(CommandKind::kSlow, 10);
  harness.cycles(50);
  EXPECT_EQ(harness.snapshot().timing.ticks, 50U);
  EXPECT_EQ(harness.snapshot().periods_per_tick, 1U);
}

TEST(ServoLoopBody, OnlyAPausedSimulatorRests) {
  const Scene scene = contact_scene();
  LoopBench<device::SimulatedDevice> paused(scene, true, {}, scene);
  const std::int64_t start_ns = paused.clock.now_ns();
  int looks = 0;
  paused.clock.after_sleep = [&](FakeClock& now) {
    if (++looks == 100) paused.command(CommandKind::kResume);
    if (now.now_ns() >= start_ns + 2'000'000'000) paused.exchange.stop = true;
  };
  run_servo_loop(paused.loop, paused.exchange, scene.sampling.rate_hz, paused.clock);
  const double resumed_s = 100.0 * (kRestS + 1.0 / scene.sampling.rate_hz);
  const double ran_s =
      static_cast<double>(paused.clock.now_ns() - start_ns) / kNanosecondsPerSecond - resumed_s;
  EXPECT_NEAR(static_cast<double>(paused.snapshot().timing.ticks), ran_s * 1000.0, 12.0);
  EXPECT_EQ(paused.snapshot().timing.missed_ticks, 0U);
}

TEST(ServoLoopBody, APausedDeviceHasNoForceAndIsKeptAwake) {
  BodyHarness harness;
  harness.arm_and_press();
  constexpr int kPauseAt = kTicksUntilArmed + 10;
  const auto press = harness.lateness_ns;
  harness.lateness_ns = [&](int cycle) {
    if (cycle == kPauseAt) harness.command(CommandKind::kPause);
    return press(cycle);
  };
  harness.run(kPauseAt + 20);
  const std::vector<double>& forces_n = harness.device.forces_n;
  ASSERT_EQ(forces_n.size(), kPauseAt + 21U) << "one write a cycle, and the last";
  EXPECT_GT(forces_n[kPauseAt - 2], 0.0);
  for (std::size_t i = kPauseAt; i < forces_n.size(); ++i) ASSERT_EQ(forces_n[i], 0.0) << i;
}

}  // namespace
}  // namespace hapticwall::session
