// Nothing in the program stalls the loop. If the machine does, the loop reports it, repeats no
// tick, and does not restore an expired force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <memory>
#include <ostream>
#include <thread>
#include <vector>

#include "app/session/loop/loop_driver.h"
#include "app/session/loop/realtime_setup.h"
#include "app/session/recorder.h"
#include "device/simulated_device.h"
#include "tests/app/session/loop/child_support.h"
#include "tests/app/session/loop/fake_writer.h"
#include "tests/app/session/loop/loop_bench.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;
using test::eventually;
using test::FakeClock;
using test::FakeDevice;
using test::FakeWriter;
using test::Heard;
using test::kFreeM;
using test::kInsideM;
using test::Shared;
using test::SharedDevice;
using test::start_child;
using test::status_of;
using test::WriterLog;

constexpr std::int64_t kPeriodNs = 1'000'000;  // of contact_scene()

// Records the start of the loop and its wake-ups.
class WatchedClock : public MonotonicClock {
 public:
  explicit WatchedClock(Heard& heard) : heard_(heard) {}
  [[nodiscard]] std::int64_t now_ns() override {
    const std::int64_t now_ns = MonotonicClock::now_ns();
    if (heard_.start_ns == 0) heard_.start_ns = now_ns;
    if (woken_ && heard_.wakes < heard_.wakes_ns.size()) {
      heard_.wakes_ns.at(heard_.wakes) = now_ns;
      ++heard_.wakes;
    }
    woken_ = false;
    return now_ns;
  }
  void sleep_until_ns(std::int64_t deadline_ns) override {
    MonotonicClock::sleep_until_ns(deadline_ns);
    woken_ = true;
  }

 private:
  Heard& heard_;
  bool woken_ = false;
};

// The loop's real body on the real clock, armed as soon as it runs, until `until` holds.
void run_watched(Heard& heard, const std::function<bool(Exchange&)>& until) {
  const Scene scene = contact_scene();
  SharedDevice device(heard);
  Exchange exchange({}, test::parameters_of(scene));
  ServoLoop loop({&device}, exchange, test::parameters_of(scene), false);
  WatchedClock clock(heard);
  std::thread thread([&] {
    static_cast<void>(set_up_realtime_thread(-1));
    run_servo_loop(loop, exchange, scene.sampling.rate_hz, clock);
  });
  EXPECT_TRUE(eventually([&] { return until(exchange); }));
  exchange.stop = true;
  thread.join();
  exchange.snapshots.update();
  const Snapshot end = exchange.snapshots.current();
  heard.ticks = end.timing.ticks;
  heard.missed = end.timing.missed_ticks;
}

// Every period has one cycle or is counted as missed; none has two.
void expect_every_period_told(const Heard& heard) {
  ASSERT_LT(heard.wakes, heard.wakes_ns.size());
  ASSERT_GT(heard.wakes, 0U);
  EXPECT_EQ(heard.ticks, heard.wakes);
  std::int64_t previous = 0;
  for (std::uint64_t i = 0; i < heard.wakes; ++i) {
    const std::int64_t period = (heard.wakes_ns.at(i) - heard.start_ns) / kPeriodNs;
    ASSERT_GT(period, previous) << "cycle " << i << " is the second of its period";
    previous = period;
  }
  EXPECT_EQ(heard.ticks + heard.missed, static_cast<std::uint64_t>(previous));
}

TEST(Stall, AnOwnerThatIsFrozenForFiveSecondsCostsNoTickAndNoRow) {
  constexpr std::uint64_t kTicks = 5000;
  const Scene scene = contact_scene();
  const QueueCapacities capacities{.plot = 1000};
  device::SimulatedDevice device(scene);
  Exchange exchange(capacities, test::parameters_of(scene));
  ServoLoop loop({&device}, exchange, test::parameters_of(scene), false);
  Recorder recorder(exchange.recorder);
  const auto log = std::make_shared<WriterLog>();
  recorder.start(std::make_unique<FakeWriter>(log));
  ASSERT_TRUE(exchange.commands.try_push({CommandKind::kStartRecording, 0}));
  FakeClock clock;
  clock.after_sleep = [&, cycles = std::uint64_t{0}](FakeClock& /*now*/) mutable {
    if (++cycles == kTicks) exchange.stop = true;
  };
  run_servo_loop(loop, exchange, scene.sampling.rate_hz, clock);
  recorder.drain_and_join();
  exchange.snapshots.update();
  EXPECT_EQ(exchange.snapshots.current().timing.ticks, kTicks);
  EXPECT_EQ(exchange.snapshots.current().timing.missed_ticks, 0U);
  EXPECT_EQ(exchange.dropped_rows, 0U);
  EXPECT_EQ(exchange.dropped_plot_samples, kTicks - capacities.plot);
  ASSERT_EQ(log->ticks.size(), kTicks);
  for (std::uint64_t tick = 0; tick < kTicks; ++tick) ASSERT_EQ(log->ticks[tick], tick);
}

// Stops a thread as a debugger does.
std::array<int, 2> g_pipe{};
void stand_still(int /*signal*/) {
  char byte = 0;
  while (read(g_pipe[0], &byte, 1) != 1) {
  }
}

TEST(Stall, AnOwnerThatStandsStillInADebuggerCostsNoTickAndNoRow) {
  constexpr std::uint64_t kMeanwhile = 500;
  ASSERT_EQ(pipe(g_pipe.data()), 0);
  const test::TemporaryFolder folder;
  const Shared heard;
  const pid_t child = start_child([&] {
    std::signal(SIGUSR1, stand_still);
    SessionOptions options;
    options.allow_no_realtime = true;
    auto session =
        LiveSession::start_on(std::make_unique<SharedDevice>(*heard), contact_scene(), options);
    if (!session || (*session)->start_recording(folder.file("a.csv"))) return;
    heard->go_on = true;
    raise(SIGUSR1);
    if ((*session)->stop_recording()) return;
    heard->note = (*session)->recording_status().dropped_rows;
    _exit(0);
  });
  ASSERT_TRUE(eventually([&] { return heard->go_on.load(); }));
  const std::uint64_t before = heard->writes;
  EXPECT_TRUE(eventually([&] { return heard->writes > before + kMeanwhile; }));
  ASSERT_EQ(write(g_pipe[1], "!", 1), 1);
  EXPECT_EQ(status_of(child), 0);
  EXPECT_EQ(heard->note, 0U);
  const auto lines = test::lines_of(folder.file("a.csv"));
  EXPECT_GT(lines.size(), kMeanwhile);
  for (std::size_t i = 2; i < lines.size(); ++i) {
    ASSERT_EQ(std::stoull(lines[i]), std::stoull(lines[i - 1]) + 1);
  }
  for (const int end : g_pipe) close(end);
}

// SIGSTOP, as from a debugger or a suspended machine.
TEST(Stall, AProcessThatWasStoppedCatchesUpWithNothingAndHasNoForce) {
  constexpr std::int64_t kStoppedNs = 150'000'000;
  const Shared heard;
  const pid_t child = start_child([&] {
    run_watched(*heard, [&](Exchange& exchange) {
      exchange.snapshots.update();
      const ArmingStatus arming = exchange.snapshots.current().arming;
      if (!heard->pushed() && arming.state == ArmingState::kOff) {
        heard->position_m = kFreeM;
        static_cast<void>(exchange.commands.try_push({CommandKind::kArm, 0}));
      }
      if (arming.gain > 0.0) heard->position_m = kInsideM;
      return heard->go_on.load();
    });
    _exit(::testing::Test::HasFailure() ? 1 : 0);
  });
  ASSERT_TRUE(eventually([&] { return heard->pushed(); }));
  ASSERT_EQ(kill(child, SIGSTOP), 0);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, WUNTRACED), child);
  ASSERT_TRUE(WIFSTOPPED(status));
  const std::uint64_t before = heard->writes;
  MonotonicClock clock;
  clock.sleep_until_ns(clock.now_ns() + kStoppedNs);  // it cannot tell us that time has passed
  EXPECT_EQ(heard->writes, before);
  ASSERT_EQ(kill(child, SIGCONT), 0);
  EXPECT_TRUE(eventually([&] { return heard->writes > before + 200; }));
  heard->go_on = true;
  EXPECT_EQ(status_of(child), 0);
  expect_every_period_told(*heard);
  EXPECT_GE(heard->missed, static_cast<std::uint64_t>(kStoppedNs / kPeriodNs) - 1);
  // One write may have been in progress; all later ones follow the hole.
  for (std::uint64_t i = before + 1; i < std::min<std::uint64_t>(heard->writes, test::kMaxHeard);
       ++i) {
    ASSERT_EQ(heard->forces_n.at(i), 0.0) << "write " << i << " after " << before;
  }
}

TEST(Stall, FourHogsBesideItAreCountedAndNothingElse) {
  constexpr int kHogs = 4;
  const Shared heard;
  std::atomic<bool> enough{false};
  std::vector<std::thread> hogs;
  for (int i = 0; i < kHogs; ++i) {
    hogs.emplace_back([&] {
      while (!enough.load(std::memory_order_relaxed)) {
      }
    });
  }
  run_watched(*heard, [&](Exchange&) { return heard->writes > 1000; });
  enough = true;
  for (std::thread& hog : hogs) hog.join();
  expect_every_period_told(*heard);
}

// ---- the same on a controlled clock: which holes disarm
struct Hole {
  double late_s;
  bool keeps_force;
};
std::ostream& operator<<(std::ostream& out, const Hole& hole) { return out << hole.late_s << " s"; }

class StallHole : public ::testing::TestWithParam<Hole> {};

TEST_P(StallHole, LongerThanAForceMayStandTakesItAway) {
  constexpr int kArmedTicks = 510;
  constexpr int kHoleAt = kArmedTicks + 10;
  const Scene scene = contact_scene();
  test::LoopBench<FakeDevice> bench(scene);
  FakeDevice& device = bench.device;
  device.position_m = kFreeM;
  bench.command(CommandKind::kArm);
  bench.clock.after_sleep = [&, cycle = 0](FakeClock& now) mutable {
    if (cycle == kArmedTicks) device.position_m = 0.051;
    if (cycle == kHoleAt) now.advance_ns(std::llround(GetParam().late_s * 1e9));
    if (++cycle == kHoleAt + 20) bench.exchange.stop = true;
  };
  run_servo_loop(bench.loop, bench.exchange, scene.sampling.rate_hz, bench.clock);
  ASSERT_EQ(device.forces_n.size(), kHoleAt + 21U) << "no burst";
  EXPECT_GT(device.forces_n.at(kHoleAt - 1), 0.0);
  for (std::size_t i = kHoleAt; i + 1 < device.forces_n.size(); ++i) {
    EXPECT_EQ(device.forces_n.at(i) > 0.0, GetParam().keeps_force) << i;
    EXPECT_EQ(device.enabled_at_write.at(i), GetParam().keeps_force) << i;
  }
  const Snapshot end = bench.snapshot();
  EXPECT_EQ(end.timing.missed_ticks,
            static_cast<std::uint64_t>(std::floor(GetParam().late_s * scene.sampling.rate_hz)));
  if (!GetParam().keeps_force) EXPECT_EQ(end.arming.note, ArmingNote::kLate);
}

INSTANTIATE_TEST_SUITE_P(Lengths, StallHole,
                         ::testing::Values(Hole{0.0005, true}, Hole{0.0195, true},
                                           Hole{0.0205, false}, Hole{5.0005, false}));

}  // namespace
}  // namespace hapticwall::session
