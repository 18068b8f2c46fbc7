// Plants that change while the loop runs, one cycle at a time.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/app/session/loop/servo_loop_support.h"

namespace hapticwall::session {
namespace {

using test::expect_same;
using test::Harness;
using test::headless;
using test::moving_scene;
using test::plant_changes;

TEST(ServoLoopPlant, PlantChangesInMotionAreThoseOfAHeadlessRun) {
  for (const double rate_hz : {1000.0, 3000.0}) {
    Harness harness(moving_scene(rate_hz));
    std::vector<ScheduledChange> changes;
    std::uint64_t tick = 0;
    int in_motion = 0;
    for (const Scene& changed : plant_changes(harness.scene)) {
      harness.cycles(83);
      tick += 83;
      in_motion += std::abs(harness.snapshot().newest.x().truth.velocity_m_per_s) > 1e-3 ? 1 : 0;
      harness.publish(changed);
      changes.push_back({tick, changed});
      static_cast<void>(harness.echoes());
      EXPECT_LE(harness.plants.count(), 3U);
    }
    harness.cycles(500);
    EXPECT_GT(in_motion, 15) << "a handle at rest proves little";
    EXPECT_EQ(harness.echoes().back().generation, harness.generation);
    EXPECT_EQ(harness.plants.count(), 1U);
    expect_same(harness.samples(), headless(harness.scene, tick + 500, changes));
  }
}

// Lost ticks, uneven periods and noise go on through changes, live as in a headless run.
TEST(ServoLoopPlant, ALoopThatIsNotIdealIsThatOfAHeadlessRun) {
  Scene scene = moving_scene();
  scene.sampling.lost_ticks = 0.2;
  scene.sampling.jitter = 0.4;
  scene.sampling.seed = 5;
  scene.x().device.position_noise_m = 20e-6;
  scene.x().device.force_noise_n = 0.1;
  Harness harness(scene);
  std::vector<ScheduledChange> changes;
  Scene changed = harness.scene;
  for (int i = 1; i <= 6; ++i) {
    harness.cycles(101);
    changed.sampling.render_every = i % 3 + 1;
    changed.sampling.lost_ticks = 0.1 * (i % 2);
    if (i % 2 == 0) changed.x().device.mass_kg = 0.05 * i;
    changed.x().device.force_noise_n = i == 3 ? 0.0 : 0.1 * i;
    harness.publish(changed);
    changes.push_back({101 * static_cast<std::uint64_t>(i), changed});
  }
  harness.cycles(300);
  expect_same(harness.samples(), headless(harness.scene, 906, changes));
}

// A change and back again between two ticks is no change, in a live session as in a headless run.
TEST(ServoLoopPlant, APlantThatTheLoopNeverSawLeavesNoTrace) {
  Harness harness(moving_scene());
  Scene heavy = harness.scene;
  heavy.x().device.mass_kg = 1.0;
  std::vector<ScheduledChange> changes;
  for (const Scene& seen : {harness.scene, heavy, heavy, harness.scene}) {
    harness.cycles(200);
    harness.publish(seen.x().device.mass_kg == 1.0 ? harness.scene : heavy);
    harness.publish(seen);
    changes.push_back({200 * (changes.size() + 1), seen});
    EXPECT_LE(harness.plants.count(), 2U);
  }
  harness.cycles(200);
  expect_same(harness.samples(), headless(harness.scene, 1000, changes));
}

TEST(ServoLoopPlant, ThePositionGoesOnAndTheBalanceStaysClosedWhateverChanges) {
  Harness harness(moving_scene());
  Scene changed = harness.scene;
  for (int i = 0; i < 12; ++i) {
    harness.cycles(97);
    changed.x().device.mass_kg = i % 2 == 0 ? 0.5 : 0.05;
    changed.x().device.friction_n = 0.1 * (i % 4);
    changed.x().hand->grip_stiffness_n_per_m = 500.0 + 300.0 * i;
    changed.x().device.amplifier_time_constant_s = 1e-3 * (i % 3);
    harness.publish(changed);
  }
  harness.cycles(97);
  const std::vector<Sample> samples = harness.samples();
  const double step_m = 1.2 * 1e-3;  // 1.2 m/s is more than it ever has
  for (std::size_t i = 1; i < samples.size(); ++i) {
    ASSERT_NEAR(samples[i].truth.position_m, samples[i - 1].truth.position_m, step_m) << i;
    ASSERT_NEAR(test::balance_error_j(samples[i]), 0.0, 1e-12) << i;
  }
}

TEST(ServoLoopPlant, ResetAfterPlantChangesStartsWithTheNewestPlantAtRest) {
  Harness harness(moving_scene());
  const std::vector<Scene> changes = plant_changes(harness.scene);
  for (const Scene& changed : changes) {
    harness.cycles(50);
    harness.publish(changed);
  }
  harness.cycles(300);
  harness.command(CommandKind::kReset);
  static_cast<void>(harness.samples());
  harness.cycles(1000);
  expect_same(harness.samples(), headless(changes.back(), 1000));
}

TEST(ServoLoopPlant, APlantPublishedBeforeTheFirstTickIsThatOfTheStart) {
  Harness harness(moving_scene(), true);
  const std::vector<Scene> changes = plant_changes(harness.scene);
  harness.publish(changes.front());
  harness.publish(changes.back());
  harness.command(CommandKind::kResume);
  harness.cycles(300);
  expect_same(harness.samples(), headless(changes.back(), 300));
}

}  // namespace
}  // namespace hapticwall::session
