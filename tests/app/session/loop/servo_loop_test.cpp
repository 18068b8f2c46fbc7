// One cycle at a time, without a thread, on the test's clock.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/app/session/loop/servo_loop_support.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;
using test::expect_same;
using test::Harness;
using test::headless;
using test::with_algorithm;

// A tick by which contact_scene() is in the wall.
constexpr int kInContactTicks = 200;

TEST(ServoLoop, TicksAreThoseOfAHeadlessRun) {
  Harness harness(contact_scene());
  harness.cycles(2000);
  expect_same(harness.samples(), headless(harness.scene, 2000));
}

TEST(ServoLoop, SwitchesAndWallChangesAreThoseOfAHeadlessRun) {
  Harness harness(contact_scene(3000.0));
  std::vector<ScheduledChange> changes;
  Scene changed = harness.scene;
  std::uint64_t tick = 0;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t index = 0; index < algorithms().size(); ++index) {
      harness.cycles(97);
      tick += 97;
      changed.algorithm.index = index;
      changed.x().walls[0].position_m = 0.05 + 1e-4 * static_cast<double>(round);
      harness.publish(changed);
      changes.push_back({tick, changed});
    }
  }
  harness.cycles(500);
  expect_same(harness.samples(), headless(harness.scene, tick + 500, changes));
}

TEST(ServoLoop, ParametersBeforeTheFirstTickAreNoChange) {
  Harness harness(contact_scene(), true);
  const Scene changed = with_algorithm(harness.scene, 0);
  harness.publish(changed);
  harness.command(CommandKind::kResume);
  harness.cycles(300);
  expect_same(harness.samples(), headless(changed, 300));
  const auto echoes = harness.echoes();
  ASSERT_EQ(echoes.size(), 1U);
  EXPECT_EQ(echoes[0].tick, 0U);
  EXPECT_EQ(echoes[0].generation, 2U);
}

TEST(ServoLoop, NewParametersAreFlaggedOnceAndEchoedWithTheirTick) {
  Harness harness(contact_scene());
  harness.cycles(10);
  harness.publish(with_algorithm(harness.scene, 0));  // overtaken: never in force
  harness.publish(with_algorithm(harness.scene, 2));
  harness.cycles(10);
  const auto samples = harness.samples();
  ASSERT_EQ(samples.size(), 20U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].generation, i < 10 ? 1U : 3U);
    EXPECT_EQ((samples[i].flags & kFlagParametersChanged) != 0, i == 10) << i;
  }
  const auto echoes = harness.echoes();
  ASSERT_EQ(echoes.size(), 2U);
  EXPECT_EQ(echoes[0].tick, 0U);
  EXPECT_EQ(echoes[0].generation, 1U);
  EXPECT_EQ(echoes[1].tick, 10U);
  EXPECT_EQ(echoes[1].generation, 3U);
}

TEST(ServoLoop, NoEchoIsLostWhenNobodyTakesThem) {
  Harness harness(contact_scene());
  harness.cycles(1);
  constexpr std::uint32_t kMany = 3 * kEchoQueueCapacity;
  for (std::uint32_t i = 0; i < kMany; ++i) {
    harness.publish(with_algorithm(harness.scene, i % 2));
    harness.command(CommandKind::kPause);
    harness.command(CommandKind::kResume);
    harness.cycles(1);
    if (harness.exchange.commands.size() > kCommandQueueCapacity / 2) break;
  }
  EXPECT_GT(harness.exchange.commands.size(), 0U) << "the echo queue was never short of room";
  std::vector<ParameterEcho> echoes = harness.echoes();
  harness.cycles(2);
  for (const ParameterEcho& echo : harness.echoes()) echoes.push_back(echo);
  EXPECT_EQ(echoes.back().generation, harness.generation) << "the newest parameters waited";
  // Every generation of a sample was echoed with the tick of its first sample.
  std::size_t next = 0;
  std::uint32_t generation = 0;
  for (const Sample& sample : harness.samples()) {
    if (sample.generation == generation) continue;
    generation = sample.generation;
    ASSERT_LT(next, echoes.size());
    EXPECT_EQ(echoes[next].generation, generation);
    EXPECT_EQ(echoes[next].tick, sample.tick);
    ++next;
  }
  EXPECT_EQ(next, echoes.size());
}

TEST(ServoLoop, SlowMotionKeepsTheCadenceAndTheSamples) {
  Harness harness(contact_scene());
  harness.cycles(100);
  harness.command(CommandKind::kSlow, 10);
  harness.cycles(1000);
  EXPECT_EQ(harness.snapshot().periods_per_tick, 10U);
  EXPECT_EQ(harness.snapshot().timing.ticks, 200U);
  EXPECT_EQ(harness.snapshot().cycles, 1100U) << "the loop answers in every period";
  harness.command(CommandKind::kPause);
  harness.command(CommandKind::kStep, 3);
  harness.cycles(3);
  EXPECT_EQ(harness.snapshot().timing.ticks, 203U) << "a step is one period";
  harness.command(CommandKind::kResume);
  harness.command(CommandKind::kSlow, 0);  // 0 counts as 1
  harness.cycles(97);
  expect_same(harness.samples(), headless(harness.scene, 300));
}

TEST(ServoLoop, PausedItKeepsItsCadenceButDoesNotTick) {
  Harness harness(contact_scene());
  harness.cycles(5);
  harness.command(CommandKind::kPause);
  harness.loop.cycle({0, 1000, 3}, harness.clock);
  const Snapshot paused = harness.snapshot();
  EXPECT_TRUE(paused.paused);
  EXPECT_EQ(paused.newest.x().tick, 4U);
  EXPECT_EQ(paused.timing.ticks, 5U);
  EXPECT_EQ(paused.cycles, 6U);
  EXPECT_EQ(paused.timing.missed_ticks, 3U);
  EXPECT_EQ(paused.timing.wake_latency_s, 1e-6);
  EXPECT_EQ(harness.samples().size(), 5U);
  harness.command(CommandKind::kResume);
  harness.cycles(1);
  EXPECT_EQ(harness.samples().front().tick, 5U);
}

TEST(ServoLoop, StepsAreExact) {
  Harness harness(contact_scene(), true);
  harness.cycles(10);
  EXPECT_TRUE(harness.samples().empty());
  harness.command(CommandKind::kStep, 5);
  harness.command(CommandKind::kStep, 2);
  harness.cycles(100);
  EXPECT_EQ(harness.samples().size(), 7U);
  harness.command(CommandKind::kStep, 1000);
  harness.cycles(3);
  harness.command(CommandKind::kResume);
  harness.cycles(1);
  harness.command(CommandKind::kPause);
  harness.cycles(100);
  EXPECT_EQ(harness.samples().size(), 4U) << "going on ends the steps";
  harness.command(CommandKind::kResume);
  harness.command(CommandKind::kStep, 50);
  harness.command(CommandKind::kPause);
  harness.cycles(100);
  EXPECT_TRUE(harness.samples().empty()) << "steps are for a paused loop only";
}

TEST(ServoLoop, ResetGoesBackToTickZeroAndRepeatsItself) {
  Harness harness(contact_scene());
  harness.cycles(777);
  const auto first = harness.samples();
  harness.command(CommandKind::kReset);
  harness.cycles(777);
  const auto second = harness.samples();
  ASSERT_EQ(second.size(), first.size());
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(Sample)), 0);
  EXPECT_EQ(harness.snapshot().resets, 1U);
  const auto echoes = harness.echoes();
  ASSERT_EQ(echoes.size(), 2U);
  EXPECT_EQ(echoes[1].tick, 0U);
}

TEST(ServoLoop, ResetTakesTheParametersOfTheMomentAsThoseOfTickZero) {
  Harness harness(contact_scene());
  harness.cycles(300);
  const Scene changed = with_algorithm(harness.scene, 0);
  harness.publish(changed);
  harness.command(CommandKind::kReset);
  static_cast<void>(harness.samples());
  harness.cycles(300);
  expect_same(harness.samples(), headless(changed, 300));
}

TEST(ServoLoop, ResetWhilePausedShowsTheStartAtOnce) {
  Harness harness(contact_scene());
  harness.cycles(kInContactTicks);
  harness.command(CommandKind::kPause);
  harness.command(CommandKind::kReset);
  harness.cycles(1);
  const Snapshot snapshot = harness.snapshot();
  EXPECT_EQ(snapshot.newest.x().tick, 0U);
  EXPECT_EQ(snapshot.newest.x().truth.position_m, harness.scene.x().device.start_m);
  EXPECT_NEAR(snapshot.newest.x().penetration_m, -0.001, 3e-4);
  EXPECT_EQ(snapshot.newest.x().force_n, 0.0);
}

TEST(ServoLoop, ThePointerLeadsAndResetForgetsIt) {
  Harness harness(contact_scene());
  harness.cycles(10);
  EXPECT_FALSE(harness.exchange.pointer_led);
  ASSERT_TRUE(
      harness.exchange.hand_moves.try_push({.m = {0.02}, .speed_m_per_s = 0.1, .to_place = true}));
  harness.cycles(2000);
  EXPECT_TRUE(harness.exchange.pointer_led);
  EXPECT_NEAR(harness.snapshot().newest.x().truth.hand_path_m, 0.02, 1e-12);
  EXPECT_NEAR(harness.snapshot().newest.x().position_m, 0.02, 2e-3);
  EXPECT_TRUE(harness.exchange.pointer_led) << "this run cannot be repeated any more";
  harness.command(CommandKind::kReset);
  static_cast<void>(harness.samples());
  harness.cycles(100);
  EXPECT_FALSE(harness.exchange.pointer_led);
  expect_same(harness.samples(), headless(harness.scene, 100));
}

TEST(ServoLoop, DropsAreCounted) {
  Harness harness(contact_scene(), false, {.plot = 10, .recorder = 4});
  harness.cycles(8);
  EXPECT_EQ(harness.exchange.recorder.size(), 0U);
  harness.command(CommandKind::kStartRecording);
  harness.cycles(7);
  harness.command(CommandKind::kStopRecording);
  harness.cycles(5);
  EXPECT_EQ(harness.exchange.recording_switches, 2U);
  EXPECT_EQ(harness.exchange.dropped_plot_samples, 10U);
  EXPECT_EQ(harness.exchange.dropped_rows, 3U);
  const auto rows = Harness::taken(harness.exchange.recorder);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows.front().tick, 8U);
}

TEST(ServoLoop, ComputeTimeIsFromWakingToTheEndOfTheTick) {
  Harness harness(contact_scene());
  const std::int64_t woke_ns = harness.clock.now_ns();
  harness.clock.advance_ns(5000);
  harness.loop.cycle({woke_ns, 0, 0}, harness.clock);
  EXPECT_DOUBLE_EQ(harness.snapshot().timing.compute_time_s, 5e-6);
  EXPECT_EQ(harness.snapshot().timing.cost_ticks, 0U) << "no quarter of a second is over yet";
  harness.cycles(1);
  EXPECT_EQ(harness.snapshot().timing.compute_time_s, 0.0);
  EXPECT_DOUBLE_EQ(harness.snapshot().timing.maximum_compute_time_s, 5e-6);
}

TEST(ServoLoop, TheCostIsThatOfTheTicksAndNotOfThePause) {
  Harness harness(contact_scene());
  constexpr std::int64_t kTickNs = 7000;
  const auto cycle = [&](std::int64_t cost_ns) {
    const std::int64_t woke_ns = harness.clock.now_ns();
    harness.clock.advance_ns(cost_ns);
    harness.loop.cycle({woke_ns, 0, 0}, harness.clock);
    harness.clock.advance_ns(1'000'000 - cost_ns);
  };
  for (int i = 0; i < 1500; ++i) cycle(i % 10 == 0 ? 3 * kTickNs : kTickNs);
  harness.command(CommandKind::kPause);
  for (int i = 0; i < 3000; ++i) cycle(10);
  const TimingStatistics timing = harness.snapshot().timing;
  EXPECT_EQ(timing.cost_ticks, 1000U);
  EXPECT_NEAR(timing.median_cost_s, 7e-6, 0.04 * 7e-6);
  EXPECT_DOUBLE_EQ(timing.maximum_cost_s, 21e-6);
}

}  // namespace
}  // namespace hapticwall::session
