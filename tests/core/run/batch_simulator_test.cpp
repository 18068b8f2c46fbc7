#include "core/run/batch_simulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/plant/plant_model.h"
#include "tests/batch_support.h"

namespace hapticwall {
namespace {

using testing::first_difference;
using testing::one_by_one;

// A press of two seconds, without friction and grip.
Scene press(double stiffness_n_per_m) {
  Scene scene;
  scene.name = "press";
  scene.duration_s = 2.0;
  scene.x().device.mass_kg = 0.05;
  scene.x().device.force_limit_n = 8.9;
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().hand = HandSettings{};
  scene.x().hand->mass_kg = 0.4;
  scene.x().hand->stiffness_n_per_m = 250.0;
  scene.x().hand->damping_n_s_per_m = 33.0;
  scene.x().hand->path = {{0.0, 0.03}, {0.5, 0.075}};
  scene.x().walls = {{0.05, stiffness_n_per_m, 0.0}};
  return scene;
}

std::size_t index_of(std::string_view algorithm) { return find_algorithm(algorithm).value(); }

// A map: stiffness by sampling rate, two algorithms.
std::vector<Scene> map() {
  std::vector<Scene> scenes;
  for (const char* algorithm : {"none", "energy-bounding"}) {
    for (int row = 0; row < 7; ++row) {
      for (int column = 0; column < 9; ++column) {
        Scene scene = press(500.0 * (column + 1));
        scene.sampling.rate_hz = 600.0 + 137.0 * row;
        scene.algorithm.index = index_of(algorithm);
        scenes.push_back(scene);
      }
    }
  }
  return scenes;
}

BatchResult on_threads(const std::vector<Scene>& scenes, int threads) {
  BatchOptions options;
  options.threads = threads;
  return simulate_batch(scenes, options);
}

TEST(BatchSimulator, OfNoScenesIsEmpty) {
  const auto batch = simulate_batch({});
  EXPECT_TRUE(batch.summaries.empty());
  EXPECT_FALSE(batch.stopped_early);
}

TEST(BatchSimulator, GivesTheSameOnAnyNumberOfThreads) {
  const std::vector<Scene> scenes = map();
  const std::vector<Summary> wanted = one_by_one(scenes);
  for (const int threads : {1, 2, 7}) {
    EXPECT_EQ(first_difference(on_threads(scenes, threads), wanted), "") << threads;
  }
}

TEST(BatchSimulator, GivesTheSameInAnyOrderAndCompany) {
  std::vector<Scene> scenes = map();
  std::reverse(scenes.begin(), scenes.end());
  EXPECT_EQ(first_difference(simulate_batch(scenes), one_by_one(scenes)), "");
  const std::vector<Scene> alone{scenes[17]};
  EXPECT_EQ(first_difference(simulate_batch(alone), one_by_one(alone)), "");
}

// A loose hand on an undamped handle, flung out of ±1 m by a stiff wall.
Scene flung(double stiffness_n_per_m) {
  Scene scene = press(stiffness_n_per_m);
  scene.x().device.encoder_m.reset();
  scene.x().device.force_limit_n.reset();
  scene.x().device.damping_n_s_per_m = 0.01;
  scene.x().hand->mass_kg.reset();
  scene.x().hand->stiffness_n_per_m = 5.0;
  scene.x().hand->damping_n_s_per_m = 0.0;
  return scene;
}

// Among neighbours that go on; before its last second and in it.
TEST(BatchSimulator, ADivergedSceneEndsAtItsTickAndNoOther) {
  std::vector<Scene> scenes;
  for (int i = 0; i < 70; ++i) {
    scenes.push_back(i % 3 == 0 ? flung(2e5 + 4e4 * i) : press(300.0));
    scenes.back().x().device.encoder_m.reset();
    scenes.back().duration_s = 0.5 + 0.03 * i;
  }
  const std::vector<Summary> wanted = one_by_one(scenes);
  std::size_t before_tail = 0;
  std::size_t in_tail = 0;
  for (const Summary& summary : wanted) {
    if (summary.verdict != Verdict::kDiverged) continue;
    ++(summary.tail_peak_to_peak_m ? in_tail : before_tail);
  }
  ASSERT_GT(before_tail, 3U);
  ASSERT_GT(in_tail, 3U);
  EXPECT_EQ(first_difference(simulate_batch(scenes), wanted), "");
}

// A point of the path between two ticks, several in one tick, one on the first and one on the last.
TEST(BatchSimulator, FollowsAPathThatBendsWithinATick) {
  std::vector<Scene> scenes;
  for (int i = 0; i < 40; ++i) {
    Scene scene = press(1000.0 + 50.0 * i);
    const double bend_s = 0.4 + 0.00013 * i;
    scene.x().hand->path = {{0.0001 * i, 0.03},        {bend_s, 0.06}, {bend_s + 0.0002, 0.061},
                            {bend_s + 0.0005, 0.0605}, {0.9, 0.055},   {1.9999, 0.06}};
    scenes.push_back(scene);
  }
  EXPECT_EQ(first_difference(simulate_batch(scenes), one_by_one(scenes)), "");
}

TEST(BatchSimulator, StopsWhenAsked) {
  const std::vector<Scene> scenes = map();
  for (const int threads : {1, 4}) {
    int questions = 0;
    BatchOptions options;
    options.threads = threads;
    options.should_stop = [&] { return ++questions > 5; };
    const auto batch = simulate_batch(scenes, options);
    EXPECT_TRUE(batch.stopped_early);
    ASSERT_EQ(batch.summaries.size(), scenes.size());
    const std::vector<Summary> wanted = one_by_one(scenes);
    std::size_t missing = 0;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      if (!batch.summaries[i]) {
        ++missing;
      } else {
        EXPECT_EQ(testing::differences(*batch.summaries[i], wanted[i]), "");
      }
    }
    EXPECT_GT(missing, 0U);
  }
}

// A scene that would run for hours must not keep Ctrl-C waiting.
TEST(BatchSimulator, StopsInTheMiddleOfALongScene) {
  for (const bool sticks : {true, false}) {
    Scene scene = press(1000.0);
    scene.duration_s = 1e6;
    if (sticks) scene.x().device.friction_n = 0.1;
    int questions = 0;
    BatchOptions options;
    options.threads = 1;
    options.should_stop = [&] { return ++questions > 3; };
    const auto batch = simulate_batch({&scene, 1}, options);
    EXPECT_TRUE(batch.stopped_early);
    EXPECT_FALSE(batch.summaries.front().has_value());
  }
}

TEST(BatchSimulator, TellsItsProgressInOrderAndToTheEnd) {
  std::vector<Scene> scenes = map();
  scenes.front().x().device.friction_n = 0.1;
  for (const int threads : {1, 4}) {
    std::vector<std::size_t> told;
    BatchOptions options;
    options.threads = threads;
    options.progress = [&](std::size_t done, std::size_t total) {
      EXPECT_EQ(total, scenes.size());
      told.push_back(done);
    };
    (void)simulate_batch(scenes, options);
    ASSERT_FALSE(told.empty());
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(std::adjacent_find(told.begin(), told.end()), told.end());
    EXPECT_EQ(told.back(), scenes.size());
  }
}

TEST(BatchSimulator, NeverCallsBackFromTwoThreadsAtATime) {
  const std::vector<Scene> scenes = map();
  std::atomic<int> inside = 0;
  std::atomic<bool> met = false;
  const auto call = [&] {
    ++inside;
    constexpr int kPatience = 1000;  // yields for another thread to come in and be met
    for (int i = 0; i < kPatience && inside == 1; ++i) std::this_thread::yield();
    if (inside > 1) met = true;
    --inside;
  };
  BatchOptions options;
  options.threads = 4;
  options.should_stop = [&] {
    call();
    return false;
  };
  options.progress = [&](std::size_t, std::size_t) { call(); };
  (void)simulate_batch(scenes, options);
  EXPECT_FALSE(met);
}

TEST(BatchSimulator, RefusesAHandThatFollowsTheMouse) {
  Scene scene = press(1000.0);
  scene.x().hand->follows_mouse = true;
  scene.x().hand->path = {};
  EXPECT_THROW((void)simulate_batch({&scene, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace hapticwall
