// Whatever the scenes, their company and the processor: a lane gives what simulate() gives, to the
// last bit. This is what holds the lanes' formulas and the scalar ones together.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/batch/batch_simulator.h"
#include "core/batch/lane_scene.h"
#include "core/servo_step.h"
#include "tests/batch_support.h"
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

// Every key that the algorithms with lanes read, or its default.
void randomise_algorithm(Scene& scene) {
  if (flip()) set(scene, "damping_n_s_per_m", log_uniform(0.01, 20.0));
  if (flip()) set(scene, "observer", flip() ? 1.0 : 0.0);
  if (flip()) set(scene, "damping_credit", flip() ? 1.0 : 0.0);
  if (flip()) set(scene, "reset_in_free_motion", flip() ? 1.0 : 0.0);
  if (flip()) set(scene, "max_damping_n_s_per_m", log_uniform(0.1, 100.0));
  if (flip()) set(scene, "velocity_floor_m_per_s", log_uniform(1e-4, 0.1));
  if (flip()) {
    set(scene, "coupling_damping_n_s_per_m", log_uniform(0.01, 10.0));
    set(scene, "coupling_stiffness_n_per_m", log_uniform(10.0, 1e6));
  }
  const double most = EnergyBounding2010::hold_stiffness(stabiliser_context(servo_settings(scene)));
  if (flip()) set(scene, "storage_stiffness_n_per_m", log_uniform(0.01 * most, most));
}

// A scene that has lanes: without friction and grip; everything else at random.
Scene random_lane_scene(std::string_view algorithm) {
  Scene scene = random_scene(algorithm);
  scene.duration_s = log_uniform(0.003, 2.5);
  scene.device.friction_n.reset();
  if (flip()) scene.device.start_m = uniform(-0.05, 0.07);
  if (flip()) scene.device.force_limit_n.reset();
  scene.hand->grip_stiffness_n_per_m.reset();
  scene.hand->grip_damping_n_s_per_m.reset();
  if (*rc::gen::inRange(0, 5) == 0) scene.hand.reset();
  if (flip()) scene.walls.front().damping_n_s_per_m = log_uniform(0.01, 30.0);
  if (*rc::gen::inRange(0, 8) == 0) scene.walls.clear();
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
    RC_ASSERT(first_difference(simulate_batch<Summary>(scenes), wanted) == "");
    RC_ASSERT(first_difference(simulate_batch<BatchVerdict>(scenes), wanted) == "");
  }
}

RC_GTEST_PROP(BatchLanes, AreScalarWithoutAnAlgorithm, ()) { lanes_are_scalar("none"); }
RC_GTEST_PROP(BatchLanes, AreScalarUnderVirtualCoupling, ()) {
  lanes_are_scalar("virtual-coupling");
}
RC_GTEST_PROP(BatchLanes, AreScalarUnderPassivityControl, ()) {
  lanes_are_scalar("passivity-control");
}
RC_GTEST_PROP(BatchLanes, AreScalarUnderEnergyBounding, ()) { lanes_are_scalar("energy-bounding"); }
RC_GTEST_PROP(BatchLanes, AreScalarUnderEnergyBounding2010, ()) {
  lanes_are_scalar("energy-bounding-2010");
}
RC_GTEST_PROP(BatchLanes, AreScalarUnderForceBounding, ()) { lanes_are_scalar("force-bounding"); }
RC_GTEST_PROP(BatchLanes, AreScalarUnderHalfSample, ()) { lanes_are_scalar("half-sample"); }
RC_GTEST_PROP(BatchLanes, AreScalarUnderEnergyBookkeeping, ()) {
  lanes_are_scalar("energy-bookkeeping");
}

// Any scene at all in any company, on any number of threads.
RC_GTEST_PROP(Batch, GivesWhatSimulateGives, ()) {
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < kLaneScenes; ++i) {
    const auto algorithm =
        *rc::gen::elementOf(std::vector(algorithms().begin(), algorithms().end()));
    scenes.push_back(flip() ? random_lane_scene("none") : random_scene(algorithm.name));
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().device.delay_ticks = 2;
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().device.amplifier_time_constant_s = 1e-3;
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().device.force_resolution_n = 0.01;
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().walls.push_back({0.06, 500.0, 0.0});
    if (*rc::gen::inRange(0, 6) == 0) scenes.back().simulator = {Integrator::kRungeKutta4, 3};
  }
  const std::vector<Summary> wanted = one_by_one(scenes);
  BatchOptions options;
  options.threads = *rc::gen::inRange(0, 5);
  RC_ASSERT(first_difference(simulate_batch<Summary>(scenes, options), wanted) == "");
  RC_ASSERT(first_difference(simulate_batch<BatchVerdict>(scenes, options), wanted) == "");
}

}  // namespace
}  // namespace hapticwall
