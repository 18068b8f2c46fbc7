// The strip of the window tells what `run` tells of the same second.
#include "app/draw/verdict/tail.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/metrics.h"
#include "core/run/simulate.h"

namespace hapticwall::draw {
namespace {

using ::testing::EndsWith;
using ::testing::StartsWith;

constexpr std::uint64_t kMoments = 20;

std::vector<Scene> built_in_scenes() {
  std::vector<Scene> scenes;
  for (const file::BuiltinScene& scene : file::builtin_scenes()) {
    const auto loaded = file::load_scene(std::string(scene.name));
    EXPECT_TRUE(loaded) << scene.name;
    if (loaded) scenes.push_back(loaded->scene);
  }
  return scenes;
}

// The run that ends after `ticks` has the same tails; their numbers, bit for bit.
void expect_same(const Tails& tails, Scene scene, std::uint64_t ticks, std::size_t& compared) {
  scene.duration_s = static_cast<double>(ticks) / scene.sampling.rate_hz;
  const AxesResult run = simulate_axes(scene);
  for (std::size_t axis = 0; axis < run.axes.size(); ++axis) {
    const Summary& expected = run.axes[axis].summary;
    const Summary& shown = tails.at(axis).summary;
    EXPECT_EQ(tails.at(axis).end_tick, ticks);
    // The strip judges its second alone. A run judges all of it while the hand moves, and calls a
    // wall that was touched earlier settled.
    const bool rests =
        hand_rests(axis_scene(scene, axis), tail_begin_tick(ticks, scene.sampling.rate_hz), ticks);
    // On a bump the hand of the other axis gives this one energy within a second.
    const bool other_gives = couples_axes(scene) && shown.verdict == Verdict::kActive;
    if (rests && shown.verdict != Verdict::kNoContact && expected.verdict != Verdict::kActive &&
        !other_gives) {
      EXPECT_EQ(shown.verdict, expected.verdict);
      EXPECT_EQ(shown.chatter_n, expected.chatter_n);
      EXPECT_EQ(shown.swing_m, expected.swing_m);
      EXPECT_EQ(shown.shake_m_per_s2, expected.shake_m_per_s2);
      ++compared;
    }
    EXPECT_EQ(shown.tail_peak_to_peak_m, expected.tail_peak_to_peak_m);
    EXPECT_EQ(shown.tail_force_mean_n, expected.tail_force_mean_n);
    EXPECT_EQ(shown.tail_force_std_n, expected.tail_force_std_n);
    EXPECT_EQ(shown.displayed_stiffness_n_per_m, expected.displayed_stiffness_n_per_m);
  }
}

TEST(Tail, IsThatOfARunAtTwentyMomentsOfEverySceneAndAlgorithm) {
  std::size_t compared = 0;  // verdicts
  for (Scene scene : built_in_scenes()) {
    const std::uint64_t every = scene.tick_count() / kMoments;
    for (std::size_t algorithm = 0; algorithm < algorithms().size(); ++algorithm) {
      SCOPED_TRACE(scene.name + " under " + std::string(algorithms()[algorithm].name));
      scene.algorithm.index = algorithm;
      TickHistory history;
      Tails tails;
      const auto push = [&](const Tick& tick) {
        history.push(std::span(&tick, 1));
        if ((tick.x().tick + 1) % every != 0) return;
        note_tails(tails, history, scene, true);
        expect_same(tails, scene, tick.x().tick + 1, compared);
      };
      static_cast<void>(simulate_axes(scene, {.on_tick = push, .should_stop = {}, .changes = {}}));
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(compared, 700U);
}

// A handle that swings 1 mm at 50 Hz, with a force that swings with it.
Tail swinging(double position_m, double force_n) {
  Scene scene;
  SampleHistory history(kHistoryCapacity);
  for (std::uint64_t tick = 0; tick < 1500; ++tick) {
    const double phase = 2.0 * std::numbers::pi * 50.0 * static_cast<double>(tick) * 1e-3;
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) * 1e-3;
    sample.truth.position_m = position_m * std::sin(phase);
    sample.force_n = force_n * std::sin(phase);
    sample.flags = kFlagInContact;
    history.push(sample);
  }
  return tail_of(history, scene, history.size(), true);
}

// 10 mm/s, the hand and the handle.
Tail following_the_hand() {
  SampleHistory history(kHistoryCapacity);
  for (std::uint64_t tick = 0; tick < 1000; ++tick) {
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) * 1e-3;
    sample.truth.position_m = sample.truth.hand_path_m = 0.01 * sample.time_s;
    sample.flags = kFlagInContact;
    history.push(sample);
  }
  return tail_of(history, Scene{}, history.size(), true);
}

TEST(Tail, TellsTheRhythm) {
  EXPECT_EQ(tail_text(swinging(1e-3, 1.0)),
            "oscillating · 2.000 mm p-p · 0.000 ± 0.707 N · no contact · 50.0 Hz");
  EXPECT_EQ(tail_text(swinging(1e-6, 1.0)),
            "buzzing · 0.002 mm p-p · 0.000 ± 0.707 N · no contact · 50.0 Hz");
  EXPECT_EQ(tail_text(swinging(1e-6, 0.0)),
            "settled · 0.002 mm p-p · 0.000 ± 0.000 N · no contact · quiet");
  EXPECT_THAT(tail_text(swinging(2.0, 1.0)), StartsWith("diverged"));
  EXPECT_EQ(tail_text({}), "no sample yet");
  EXPECT_THAT(tail_text(following_the_hand()), EndsWith(" · the hand moves"));
}

TEST(Tail, FollowsTheNewestSampleOfEveryAxis) {
  Tails tails;
  TickHistory history;
  Scene scene;
  note_tails(tails, history, scene, true);
  EXPECT_EQ(tails[0].end_tick, 0U);
  Tick tick;
  tick.axes[0].force_n = 2.0;
  history.push(std::span(&tick, 1));
  note_tails(tails, history, scene, true);
  EXPECT_EQ(tails[0].end_tick, 1U);
  EXPECT_EQ(tails[0].summary.tail_force_mean_n, 2.0);
  EXPECT_EQ(tails[1].end_tick, 0U);  // the scene has no second axis
  tick.axes[0].tick = 1;
  tick.axes[0].time_s = 1e-3;
  tick.axes[0].force_n = 4.0;
  history.push(std::span(&tick, 1));
  note_tails(tails, history, scene, true, 0.0);
  EXPECT_EQ(tails[0].summary.tail_force_mean_n, 2.0) << "back in time";
  note_tails(tails, history, scene, true);
  EXPECT_EQ(tails[0].summary.tail_force_mean_n, 3.0);
  history.clear();
  note_tails(tails, history, scene, true);
  EXPECT_EQ(tail_text(tails[0]), "no sample yet");
}

}  // namespace
}  // namespace hapticwall::draw
