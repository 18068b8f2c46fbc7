// The counterpart of a session is the run of its algorithm with the session's hand.
#include "app/session/counterpart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"

namespace hapticwall::session {
namespace {

Scene scene_under(std::string_view name, std::string_view algorithm) {
  Scene scene = file::load_scene(std::string(name))->scene;
  scene.algorithm.index = *find_algorithm(algorithm);
  return scene;
}

std::vector<Sample> run(const Scene& scene) {
  std::vector<Sample> samples;
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) { samples.push_back(sample); };
  static_cast<void>(simulate(scene, options));
  return samples;
}

// Bits of what the cards and plots of the first window show.
void expect_same(const Sample& a, const Sample& b) {
  ASSERT_EQ(a.tick, b.tick);
  ASSERT_EQ(a.truth.position_m, b.truth.position_m) << "tick " << a.tick;
  ASSERT_EQ(a.force_n, b.force_n) << "tick " << a.tick;
  ASSERT_EQ(a.position_m, b.position_m) << "tick " << a.tick;
  ASSERT_EQ(a.energy_scv_j, b.energy_scv_j) << "tick " << a.tick;
  ASSERT_EQ(a.truth.hand_path_m, b.truth.hand_path_m) << "tick " << a.tick;
}

TEST(Counterpart, IsTheRunOfItsAlgorithmInEveryBuiltInScene) {
  std::size_t scenes = 0;
  for (const file::BuiltinScene& builtin : file::builtin_scenes()) {
    Scene scene = file::load_scene(std::string(builtin.name))->scene;
    if (scene.two_axes()) continue;
    SCOPED_TRACE(builtin.name);
    ++scenes;
    const std::vector<Sample> session = run(scene);
    scene.algorithm.index = *find_algorithm("energy-bounding-2010");
    const std::vector<Sample> expected = run(scene);
    ASSERT_FALSE(session.empty());
    Counterpart counterpart(scene, session.front());
    const std::size_t ticks = std::min(session.size(), expected.size());
    for (std::size_t i = 0; i < ticks; ++i) {
      const Sample* sample = counterpart.follow(session[i]);
      ASSERT_NE(sample, nullptr);
      ASSERT_NO_FATAL_FAILURE(expect_same(*sample, expected[i]));
    }
  }
  EXPECT_GE(scenes, 10U);
}

// The pointer takes the hand away from its script, to and fro, and releases it.
TEST(Counterpart, HasTheHandThatThePointerLeads) {
  const Scene scene = scene_under("press", "virtual-coupling");
  SteppedAxis session(scene);
  std::optional<Counterpart> counterpart;
  for (std::uint64_t tick = 0; tick < 4000; ++tick) {
    const Sample* sample = session.compute();
    ASSERT_NE(sample, nullptr);
    if (!counterpart) counterpart.emplace(scene, *sample);
    const Sample* other = counterpart->follow(*sample);
    ASSERT_NE(other, nullptr);
    ASSERT_NO_FATAL_FAILURE(expect_same(*other, *sample));
    const auto time_s = static_cast<double>(tick) / 1000.0;
    if (tick >= 500 && tick < 2500)
      session.plant().lead_hand_to(0.05 + 0.02 * std::sin(20.0 * time_s));
    if (tick == 2500) session.plant().release_hand();
    session.advance();
  }
}

TEST(Counterpart, TakesAChangeAtItsTick) {
  const Scene scene = scene_under("press", "none");
  Scene stiffer = scene;
  stiffer.x().walls.front().stiffness_n_per_m = 50e3;
  const std::vector<Sample> session = run(scene);
  SteppedAxis expected(scene);
  Counterpart counterpart(scene, session.front());
  for (const Sample& sample : session) {
    if (sample.tick == 1200) {
      expected.change(stiffer);
      counterpart.change(stiffer);
    }
    const Sample* other = counterpart.follow(sample);
    ASSERT_NE(other, nullptr);
    const Sample* wanted = expected.compute();
    ASSERT_NE(wanted, nullptr);
    ASSERT_NO_FATAL_FAILURE(expect_same(*other, *wanted));
    expected.advance();
  }
}

// A window that was too slow for its queue misses samples; the script fills the gap.
TEST(Counterpart, GoesOnAfterAGap) {
  const Scene scene = scene_under("press", "energy-bounding");
  const std::vector<Sample> session = run(scene);
  Counterpart counterpart(scene, session.front());
  ASSERT_NE(counterpart.follow(session[0]), nullptr);
  const Sample* after = counterpart.follow(session[3000]);
  ASSERT_NE(after, nullptr);
  EXPECT_EQ(after->tick, 3000U);
  EXPECT_EQ(after->truth.hand_path_m, session[3000].truth.hand_path_m);
  const Sample* last = nullptr;
  for (std::size_t i = 3001; i < session.size(); ++i) last = counterpart.follow(session[i]);
  ASSERT_NE(last, nullptr);
  EXPECT_NEAR(last->truth.position_m, session.back().truth.position_m, 1e-4);
}

TEST(Counterpart, EndsWhereItDiverges) {
  const Scene calm = scene_under("press", "energy-bounding");
  Scene wild = scene_under("press", "none");
  wild.x().device.force_limit_n.reset();
  wild.x().walls.front().stiffness_n_per_m = 1e9;
  const std::vector<Sample> session = run(calm);
  Counterpart counterpart(wild, session.front());
  std::size_t ticks = 0;
  while (ticks < session.size() && counterpart.follow(session[ticks]) != nullptr) ++ticks;
  EXPECT_LT(ticks, session.size());
}

}  // namespace
}  // namespace hapticwall::session
