// A lane gives the bits of simulate() for any scenes in any company on any processor: this test
// holds the lanes' formulas and the scalar ones together.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/batch/batch_simulator.h"
#include "core/batch/lane_scene.h"
#include "core/loop/servo_step.h"
#include "tests/batch_support.h"
#include "tests/position_bench.h"
#include "tests/property/scene_generator.h"

namespace hapticwall {
namespace {

using testing::first_difference;
using testing::flip;
using testing::log_uniform;
using testing::one_by_one;
using testing::random_scene;
using testing::uniform;

constexpr std::size_t kLaneScenes = 48;

void set(Scene& scene, std::string_view key, double value) {
  scene.algorithm.values.at(*find_algorithm_parameter(key)) = value;
}

// Every key that an algorithm reads, or its default.
void randomise_algorithm(Scene& scene) {
  if (flip()) set(scene, "damping_n_s_per_m", log_uniform(0.01, 20.0));
  if (flip()) set(scene, "observer", *rc::gen::inRange(0, 3));
  if (flip()) set(scene, "damping_credit", flip() ? 1.0 : 0.0);
  if (flip()) set(scene, "reset_in_free_motion", flip() ? 1.0 : 0.0);
  if (flip()) set(scene, "max_damping_n_s_per_m", log_uniform(0.1, 100.0));
  if (flip()) set(scene, "velocity_floor_m_per_s", log_uniform(1e-4, 0.1));
  if (flip()) {
    set(scene, "coupling_damping_n_s_per_m", log_uniform(0.01, 10.0));
    set(scene, "coupling_stiffness_n_per_m", log_uniform(10.0, 1e6));
  }
  const double most = testing::max_storage_stiffness(servo_settings(scene));
  if (flip()) set(scene, "storage_stiffness_n_per_m", log_uniform(0.01 * most, most));
}

// A random scene that has lanes: without friction and grip.
Scene random_lane_scene(std::string_view algorithm) {
  Scene scene = random_scene(algorithm);
  scene.duration_s = log_uniform(0.003, 2.5);
  scene.x().device.friction_n.reset();
  if (flip()) scene.x().device.start_m = uniform(-0.05, 0.07);
  if (flip()) scene.x().device.force_limit_n.reset();
  scene.x().hand->grip_stiffness_n_per_m.reset();
  scene.x().hand->grip_damping_n_s_per_m.reset();
  if (*rc::gen::inRange(0, 5) == 0) scene.x().hand.reset();
  if (flip()) scene.x().walls.front().damping_n_s_per_m = log_uniform(0.01, 30.0);
  if (*rc::gen::inRange(0, 8) == 0) scene.x().walls.clear();
  randomise_algorithm(scene);
  return scene;
}

std::vector<Scene> random_lane_scenes(std::string_view algorithm) {
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < kLaneScenes; ++i) {
    scenes.push_back(random_lane_scene(algorithm));
    RC_ASSERT(!validate(scenes.back()).has_value());
    RC_ASSERT(batch::lane_kind(scenes.back()).has_value());
  }
  return scenes;
}

void lanes_are_scalar(std::string_view algorithm) {
  const std::vector<Scene> scenes = random_lane_scenes(algorithm);
  const std::vector<Summary> wanted = one_by_one(scenes);
  for (const std::int64_t target : testing::lane_targets()) {
    const testing::OnlyTarget only(target);
    RC_LOG() << hwy::TargetName(target) << '\n';
    RC_ASSERT(first_difference(simulate_batch(scenes), wanted) == "");
  }
}

// On every instruction set, for every algorithm.
RC_GTEST_PROP(BatchLanes, AreScalarUnderEveryAlgorithm, ()) {
  for (const AlgorithmDescription& algorithm : algorithms()) lanes_are_scalar(algorithm.name);
}

// Any scene at all in any company, on any number of threads.
RC_GTEST_PROP(Batch, GivesWhatSimulateGives, ()) {
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < kLaneScenes; ++i) {
    const auto algorithm =
        *rc::gen::elementOf(std::vector(algorithms().begin(), algorithms().end()));
    scenes.push_back(flip() ? random_lane_scene("none") : random_scene(algorithm.name));
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().x().device.delay_ticks = 2;
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().x().device.amplifier_time_constant_s = 1e-3;
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().x().device.force_resolution_n = 0.01;
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().x().device.max_force_rate_n_per_s = 300.0;
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().x().walls.push_back({0.06, 500.0, 0.0});
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().simulator = {Integrator::kRungeKutta4, 3};
  }
  const std::vector<Summary> wanted = one_by_one(scenes);
  BatchOptions options;
  options.threads = *rc::gen::inRange(0, 5);
  RC_ASSERT(first_difference(simulate_batch(scenes, options), wanted) == "");
}

}  // namespace
}  // namespace hapticwall
