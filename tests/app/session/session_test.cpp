// Sessions on a real thread. Whatever is waited for is a condition, counted in ticks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "app/session/live_session.h"
#include "app/session/scene_change.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

using test::algorithm;
using test::all_samples;
using test::contact_scene;
using test::eventually;
using test::FakeDevice;
using test::generation_is;
using test::loop_session;
using test::started;
using test::started_paused;
using test::ticks_reach;
using test::TurnedSession;
using ::testing::HasSubstr;

TEST(Session, RunsAtItsRateAndSaysHowItIsSetUp) {
  const auto session = started(contact_scene());
  ASSERT_TRUE(ticks_reach(*session, 100));
  const Snapshot snapshot = session->snapshot();
  EXPECT_EQ(snapshot.newest.x().tick + 1, snapshot.timing.ticks);
  EXPECT_GE(snapshot.timing.maximum_wake_latency_s, snapshot.timing.wake_latency_s);
  EXPECT_GT(snapshot.timing.maximum_compute_time_s, 0.0);
  TimingHistograms histograms;
  session->read_timing(histograms);
  EXPECT_GE(histograms.wake_latency.total(), snapshot.timing.ticks);
  EXPECT_GE(histograms.compute_time.total(), snapshot.timing.ticks);
  EXPECT_GE(quantiles(histograms.wake_latency).maximum_ns,
            std::llround(snapshot.timing.maximum_wake_latency_s * kNanosecondsPerSecond));
  EXPECT_FALSE(snapshot.paused);
  EXPECT_FALSE(session->realtime_status().text.empty());
  EXPECT_EQ(session->realtime_status().advice.empty(),
            session->realtime_status().fifo_priority && session->realtime_status().memory_locked);
}

TEST(Session, EveryTickComesOutOnceAndInOrder) {
  TurnedSession session(contact_scene(10000.0));
  const std::vector<Sample> samples = session.pass(5000);
  ASSERT_EQ(samples.size(), 5000U);
  for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_EQ(samples[i].tick, i);
  EXPECT_EQ(session->dropped_plot_samples(), 0U);
}

TEST(Session, ASlowOwnerLosesPlotSamplesAndIsTold) {
  SessionOptions options;
  options.queues.plot = 16;
  TurnedSession session(contact_scene(), options);
  session.clock().advance_ns(50'000'000);
  EXPECT_EQ(all_samples(*session).size(), 16U);
  EXPECT_EQ(session->dropped_plot_samples(), 34U);
}

TEST(Session, StepsAreExactHoweverManyAtOnce) {
  SessionOptions options;
  options.start_paused = true;
  TurnedSession session(contact_scene(5000.0), options);
  session->step(5);
  EXPECT_EQ(session.pass(200).size(), 5U);
  // More commands than the queue holds: none is lost, and none of the ticks either.
  for (int i = 0; i < 1000; ++i) session->step();
  EXPECT_EQ(session.pass(2000).size(), 1000U);
  session->step(3);
  EXPECT_EQ(session.pass(200).back().tick, 1007U);
  EXPECT_EQ(session->snapshot().timing.ticks, 1008U);
  EXPECT_TRUE(session->snapshot().paused);
}

TEST(Session, PauseHoldsAndResumeGoesOnWithTheNextTick) {
  TurnedSession session(contact_scene());
  EXPECT_EQ(session.pass(20).back().tick, 19U);
  session->pause(true);
  EXPECT_TRUE(session.pass(100).empty());
  EXPECT_TRUE(session->snapshot().paused);
  session->step(7);
  EXPECT_EQ(session.pass(100).size(), 7U);
  session->pause(false);
  const std::vector<Sample> samples = session.pass(100);
  ASSERT_GT(samples.size(), 80U) << "it may have rested for 10 ms";
  for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_EQ(samples[i].tick, 27 + i);
  EXPECT_EQ(session->snapshot().timing.missed_ticks, 0U);
}

TEST(Session, ResetStartsOverAndRepeatsItself) {
  TurnedSession session(contact_scene(5000.0));
  const std::vector<Sample> first = session.pass(300);
  session->reset();
  const std::vector<Sample> second = session.pass(300);
  EXPECT_EQ(session->snapshot().resets, 1U);
  session->pause(true);
  session->reset();
  EXPECT_TRUE(session.pass(20).empty());
  EXPECT_TRUE(session->snapshot().paused) << "a reset keeps a pause";
  EXPECT_EQ(session->snapshot().newest.x().tick, 0U);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(Sample)), 0);
}

TEST(Session, ChangesTakeEffectAndProblemsLeaveEverythingAsItWas) {
  TurnedSession session(contact_scene());
  EXPECT_EQ(session.pass(5).back().generation, 1U);
  auto walls = session->scene().x().walls;
  walls[0].stiffness_n_per_m = std::numeric_limits<double>::quiet_NaN();
  const auto problem = session->set_walls(walls);
  ASSERT_TRUE(problem);
  EXPECT_THAT(problem->key, HasSubstr("stiffness_n_per_m"));
  EXPECT_TRUE(session->set_algorithm(algorithm(algorithms().size())));
  EXPECT_EQ(session->scene().x().walls[0].stiffness_n_per_m, 35000.0);

  walls[0].stiffness_n_per_m = 1000.0;
  EXPECT_FALSE(session->set_walls(walls));
  EXPECT_FALSE(session->set_walls(walls)) << "the same again is no change";
  EXPECT_EQ(session->scene().x().walls[0].stiffness_n_per_m, 1000.0);
  EXPECT_EQ(session.pass(1).back().generation, 2U);
  EXPECT_FALSE(session->set_algorithm(algorithm(0)));
  EXPECT_FALSE(session->set_algorithm(algorithm(0)));
  EXPECT_EQ(session.pass(1).back().generation, 3U);
  walls[0].stiffness_n_per_m = 2000.0;
  EXPECT_FALSE(session->set_walls(walls));
  EXPECT_EQ(session.pass(1).back().generation, 4U);
}

TEST(Session, ThePlantChangesWhileItRunsAndProblemsLeaveItAsItWas) {
  TurnedSession session(contact_scene());
  Scene wanted = session->scene();
  wanted.x().device.mass_kg = -1.0;
  const auto invalid = session->change_scene(wanted);
  ASSERT_TRUE(invalid);
  EXPECT_EQ(invalid->key, "device.mass_kg");
  wanted = session->scene();
  wanted.x().hand->mass_kg.reset();
  const auto contradiction = session->change_scene(wanted);
  ASSERT_TRUE(contradiction);
  EXPECT_THAT(contradiction->message, HasSubstr("hand.mass_kg is missing"));
  wanted = session->scene();
  wanted.sampling.rate_hz = 2000.0;
  const auto fixed = session->change_scene(wanted);
  ASSERT_TRUE(fixed);
  EXPECT_EQ(fixed->key, "sampling.rate_hz");
  EXPECT_EQ(session->scene().x().device.mass_kg, 0.05);
  EXPECT_FALSE(session->change_scene(session->scene())) << "the same again is no change";

  wanted = session->scene();
  wanted.name = "another";
  wanted.x().device.friction_n = 1000.0;
  wanted.simulator = {Integrator::kSemiImplicitEuler, 5};
  ASSERT_FALSE(session->change_scene(wanted));
  EXPECT_EQ(session->scene().simulator, wanted.simulator);
  EXPECT_EQ(session->scene().name, "contact");
  // This friction is large enough to hold the handle.
  const std::vector<Sample> samples = session.pass(50);
  EXPECT_EQ(samples.back().truth.velocity_m_per_s, 0.0);
  EXPECT_EQ(samples.front().generation, 2U);
}

TEST(Session, ChangesFasterThanTheLoopLeaveNothingBehindAndTheLastOneWins) {
  const auto session = loop_session(100.0);
  Scene wanted = session->scene();
  constexpr int kChanges = 3000;
  for (int i = 0; i < kChanges; ++i) {
    wanted.x().device.mass_kg = 0.1 + 1e-4 * i;
    ASSERT_FALSE(session->change_scene(wanted));
    ASSERT_LE(session->plants_kept(), 3U);
  }
  ASSERT_TRUE(generation_is(*session, kChanges + 1U));
  EXPECT_TRUE(eventually([&] {
    static_cast<void>(session->snapshot());
    return session->plants_kept() == 1U;
  }));
  EXPECT_EQ(session->scene().x().device.mass_kg, wanted.x().device.mass_kg);
}

TEST(Session, WhilePausedNothingPilesUpEither) {
  const auto session = started_paused(contact_scene());
  Scene wanted = session->scene();
  constexpr int kChanges = 300;
  for (int i = 0; i < kChanges; ++i) {
    wanted.x().device.mass_kg = 0.1 + 1e-4 * i;
    ASSERT_FALSE(session->change_scene(wanted));
  }
  EXPECT_LE(static_cast<LoopSession&>(*session).plants_kept(), 1U);
  session->step(1);
  ASSERT_TRUE(ticks_reach(*session, 1));
  EXPECT_EQ(session->snapshot().generation, kChanges + 1U);
  EXPECT_EQ(all_samples(*session).front().flags & kFlagParametersChanged, 0U);
}

// A device of the real world has its own mass, whatever the scene says.
TEST(Session, ARealDeviceGetsNoPlantButTheControllersPart) {
  auto device = std::make_unique<FakeDevice>();
  device->position_m = 0.03;
  const Scene scene = scene_on(contact_scene(), device->info());
  EXPECT_FALSE(scene.x().hand) << "a person's own is there";
  LoopSession session(test::one_device(std::move(device)), scene, SessionOptions{});
  Scene wanted = session.scene();
  wanted.x().device.mass_kg = 0.3;
  wanted.x().device.force_limit_n = 0.5;
  ASSERT_FALSE(session.change_scene(wanted));
  EXPECT_EQ(session.plants_kept(), 0U);
  ASSERT_TRUE(eventually([&] { return session.snapshot().generation == 2; }));
  EXPECT_EQ(session.scene().x().device.force_limit_n, 0.5);
}

TEST(Session, TheHandIsLedAndStaysUntilTheReset) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  TurnedSession session(contact_scene());
  const auto hand_gets_to = [&](double place_m) {
    return std::abs(session.pass(3000).back().truth.hand_path_m - place_m) < 1e-9;
  };
  session->move_hand(test::hand_to(0.03));
  EXPECT_TRUE(hand_gets_to(0.03));
  session->move_hand(test::hand_to(kNan));  // ignored, like the next ones
  session->move_hand(test::hand_to(std::numeric_limits<double>::infinity()));
  session->move_hand({.m = {0.01}, .duration_s = -1.0});
  session->move_hand({.m = {0.01}, .duration_s = kNan});
  session->move_hand({.m = {0.01}, .speed_m_per_s = 0.0, .to_place = true});
  session->move_hand({.m = {0.002}, .duration_s = 0.01});
  EXPECT_TRUE(hand_gets_to(0.032));
  EXPECT_TRUE(hand_gets_to(0.032)) << "it stays";
  session->move_hand({.m = {0.001}, .duration_s = 1e6});
  session->move_hand(test::hand_to(0.04));
  EXPECT_TRUE(hand_gets_to(0.04)) << "at once";
  session->move_hand({.m = {0.001}, .duration_s = 1e6});
  session->reset();
  EXPECT_TRUE(hand_gets_to(0.075)) << "the script's end";
}

}  // namespace
}  // namespace hapticwall::session
