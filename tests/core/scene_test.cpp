#include "core/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/scene_keys.h"

namespace hapticwall {
namespace {

Scene good_scene() {
  Scene scene;
  scene.name = "good";
  scene.x().walls = {{0.05, 35e3, 0.0}};
  scene.x().hand.emplace();
  scene.x().hand->mass_kg = 0.4;
  scene.x().hand->grip_stiffness_n_per_m = 1000.0;
  scene.x().hand->grip_damping_n_s_per_m = 1.0;
  scene.x().hand->path = {{0.0, 0.03}, {1.0, 0.06}};
  return scene;
}

TEST(Validate, TakesAGoodScene) { EXPECT_FALSE(validate(good_scene()).has_value()); }

struct BadScene {
  std::function<void(Scene&)> spoil;
  std::string key;
};

// Numbers of run, sampling and device out of range.
std::vector<BadScene> bad_numbers() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  return {
      {[](Scene& s) { s.duration_s = 0.0; }, "duration_s"},
      {[](Scene& s) {
         s.duration_s = 1e6;
         s.sampling.rate_hz = 1e5;
       },
       "duration_s"},
      {[=](Scene& s) { s.sampling.rate_hz = nan; }, "sampling.rate_hz"},
      {[](Scene& s) { s.sampling.rate_hz = 0.0; }, "sampling.rate_hz"},
      {[](Scene& s) { s.x().device.mass_kg = -0.05; }, "device.mass_kg"},
      {[](Scene& s) { s.x().device.mass_kg = 0.0; }, "device.mass_kg"},
      {[=](Scene& s) { s.x().device.damping_n_s_per_m = infinity; }, "device.damping_n_s_per_m"},
      {[](Scene& s) { s.x().device.friction_n = -1.0; }, "device.friction_n"},
      {[](Scene& s) { s.x().device.encoder_m = 1.0; }, "device.encoder_m"},
      {[](Scene& s) { s.x().device.encoder_m = 1e-320; }, "device.encoder_m"},
      {[](Scene& s) { s.x().device.force_limit_n = -1.0; }, "device.force_limit_n"},
      {[](Scene& s) { s.x().device.start_m = 2.0; }, "device.start_m"},
  };
}

// Wrong walls, hands and paths.
std::vector<BadScene> bad_parts() {
  return {
      {[](Scene& s) { s.x().walls[0].stiffness_n_per_m = 1e10; }, "wall.stiffness_n_per_m"},
      {[](Scene& s) {
         s.x().walls.push_back({0.06, -1.0, 0.0});
       },
       "wall[1].stiffness_n_per_m"},
      {[](Scene& s) { s.x().walls.resize(9); }, "wall"},
      {[](Scene& s) { s.x().hand->mass_kg.reset(); }, "hand.grip_stiffness_n_per_m"},
      {[](Scene& s) { s.x().hand->grip_stiffness_n_per_m.reset(); }, "hand.grip_damping_n_s_per_m"},
      {[](Scene& s) { s.x().hand->path = {}; }, "hand.path"},
      {[](Scene& s) { s.x().hand->follows_mouse = true; }, "hand.path"},
      {[](Scene& s) {
         s.x().hand->path = {{1.0, 0.03}, {1.0, 0.04}};
       },
       "hand.path[1]"},
      {[](Scene& s) {
         s.x().hand->path = {{-1.0, 0.03}};
       },
       "hand.path[0]"},
      {[](Scene& s) {
         s.x().hand->path = {{0.0, 3.0}};
       },
       "hand.path[0]"},
      {[](Scene& s) { s.x().hand->path.edit().resize(kMaxPathPoints + 1); }, "hand.path"},
  };
}

// Wrong keys of algorithm and simulator.
std::vector<BadScene> bad_choices() {
  return {
      {[](Scene& s) { s.algorithm.index = 99; }, "algorithm.name"},
      {[](Scene& s) { s.algorithm.values[*find_algorithm_parameter("rest_force_step_n")] = -1.0; },
       "algorithm.rest_force_step_n"},
      {[](Scene& s) { s.algorithm.values[*find_algorithm_parameter("then")] = 2.0; },
       "algorithm.then"},
      {[](Scene& s) {
         s.algorithm.values[*find_algorithm_parameter("storage_stiffness_n_per_m")] = 1001.0;
       },
       "algorithm.storage_stiffness_n_per_m"},
      {[](Scene& s) { s.algorithm.values[*find_algorithm_parameter("observer")] = 7.0; },
       "algorithm.observer"},
      {[](Scene& s) {
         s.algorithm.values[*find_algorithm_parameter("coupling_damping_n_s_per_m")] = 2.0;
       },
       "algorithm.coupling_damping_n_s_per_m"},
      {[](Scene& s) { s.simulator.substeps = 2; }, "simulator.substeps"},
      {[](Scene& s) {
         s.simulator = {Integrator::kRungeKutta4, 0};
       },
       "simulator.substeps"},
      {[](Scene& s) {
         s.simulator = {Integrator::kRungeKutta4, 1001};
       },
       "simulator.substeps"},
  };
}

void expect_named(const BadScene& bad) {
  Scene scene = good_scene();
  bad.spoil(scene);
  const auto problem = validate(scene);
  ASSERT_TRUE(problem.has_value()) << bad.key;
  EXPECT_EQ(problem->key, bad.key) << problem->message;
  EXPECT_FALSE(problem->message.empty());
  EXPECT_EQ(problem->message.find('\n'), std::string::npos);
}

TEST(Validate, NamesTheKeyThatIsWrong) {
  for (const auto& table : {bad_numbers(), bad_parts(), bad_choices()}) {
    for (const BadScene& bad : table) expect_named(bad);
  }
}

TEST(Validate, AMouseHandNeedsNoPath) {
  Scene scene = good_scene();
  scene.x().hand->path = {};
  scene.x().hand->follows_mouse = true;
  EXPECT_FALSE(validate(scene).has_value());
}

TEST(Scene, CountsItsTicks) {
  Scene scene;
  scene.duration_s = 0.3;
  EXPECT_EQ(scene.tick_count(), 300U);
  scene.duration_s = 1e-9;
  EXPECT_EQ(scene.tick_count(), 1U);
}

}  // namespace
}  // namespace hapticwall
