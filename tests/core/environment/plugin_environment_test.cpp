#include "core/environment/plugin/plugin_environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/algorithm/plugin/include/hapticwall/environment.h"
#include "core/run/simulate.h"
#include "core/scene_keys.h"
#include "tests/position_bench.h"

namespace hapticwall {
namespace {

// A spring about 0, with a state that counts its ticks.
const hw_parameter kStiffness{"test_stiffness_n_per_m", "N/m", 0.0, 1e6, 100.0, "K"};

struct State {
  double stiffness;
  double ticks;
};
hw_environment spring() {
  hw_environment plugin{};
  plugin.abi = HAPTICWALL_ENVIRONMENT_ABI;
  plugin.size = sizeof(hw_environment);
  plugin.state_bytes = sizeof(State);
  plugin.parameter_count = 1;
  plugin.parameters = &kStiffness;
  plugin.name = "test-spring";
  plugin.title = plugin.idea = "a spring";
  plugin.equation = "";
  plugin.configure = [](void* state, const hw_environment_context* context) {
    static_cast<State*>(state)->stiffness = context->parameters[0];
  };
  plugin.reset = [](void* state) { static_cast<State*>(state)->ticks = 0.0; };
  plugin.force = [](const void* state, const hw_motion* motion) {
    const auto& self = *static_cast<const State*>(state);
    if (motion->position_m > 0.9) throw std::runtime_error("a test");
    return self.stiffness * motion->position_m + 1000.0 * self.ticks;
  };
  plugin.advance = [](void* state, const hw_motion*, double applied_force_n) {
    static_cast<State*>(state)->ticks += applied_force_n != 0.0 ? 1.0 : 0.0;
  };
  return plugin;
}

Scene scene_in_spring() {
  static const hw_environment kPlugin = spring();
  static const std::size_t kIndex = add_environment_plugin(kPlugin);
  Scene scene;
  scene.environment.index = kIndex;
  return scene;
}

TEST(PluginEnvironment, GivesForceKeysAndStateOfItsOwn) {
  Scene scene = scene_in_spring();
  ASSERT_FALSE(validate(scene));
  testing::PositionBench bench(servo_settings(scene));
  EXPECT_EQ(bench.move_to(0.25).wall_force_n, 25.0);
  const Sample second = bench.move_to(0.5);
  EXPECT_EQ(second.wall_force_n, 1050.0);
  EXPECT_NE(second.flags & kFlagInContact, 0U) << "a force without a depth is a contact";
  EXPECT_EQ(second.penetration_m, 0.0);
  EXPECT_EQ(second.stiffness_n_per_m, 0.0);
  bench.reset();
  EXPECT_EQ(bench.move_to(0.25).wall_force_n, 25.0);
  find_scene_number(scene, "environment.test_stiffness_n_per_m").value().set(scene, 8.0);
  testing::PositionBench softer(servo_settings(scene));
  EXPECT_EQ(softer.move_to(0.25).wall_force_n, 2.0);
}

TEST(PluginEnvironment, AnExceptionEndsTheForce) {
  const Scene scene = scene_in_spring();
  testing::PositionBench bench(servo_settings(scene));
  EXPECT_EQ(bench.move_to(0.5).force_n, 50.0);
  EXPECT_EQ(bench.move_to(0.95).force_n, 0.0);
  EXPECT_TRUE(bench.servo().state().failed);
  EXPECT_EQ(bench.move_to(0.5).force_n, 0.0);
  EXPECT_EQ(environment_fault(scene.environment.index), LibraryFault::kThrew);
}

// Energy bounding would add its bound to the last force.
TEST(PluginEnvironment, NoAlgorithmMakesAForceOfNoForce) {
  for (std::size_t algorithm = 0; algorithm < algorithms().size(); ++algorithm) {
    Scene scene = scene_in_spring();
    scene.algorithm.index = algorithm;
    testing::PositionBench bench(servo_settings(scene));
    (void)bench.move_to(0.5);
    EXPECT_EQ(bench.move_to(0.95).force_n, 0.0) << algorithms()[algorithm].name;
    EXPECT_EQ(bench.move_to(0.4).force_n, 0.0) << algorithms()[algorithm].name;
  }
}

TEST(PluginEnvironment, WithoutAStiffnessTheAlgorithmsThatNeedOneAreRefused) {
  for (const char* name : {"virtual-coupling", "energy-limited-spring"}) {
    Scene scene = scene_in_spring();
    scene.algorithm.index = find_algorithm(name).value();
    const auto problem = validate(scene);
    ASSERT_TRUE(problem) << name;
    EXPECT_EQ(problem->key, "algorithm.name");
  }
}

TEST(PluginEnvironment, EveryMistakeHasALine) {
  const auto problem_of = [](auto&& spoil) {
    hw_environment plugin = spring();
    plugin.name = "test-other";
    spoil(plugin);
    return environment_problem(plugin);
  };
  EXPECT_EQ(problem_of([](hw_environment&) {}), "");
  EXPECT_NE(problem_of([](hw_environment& p) { p.abi = 7; }).find("ABI 7"), std::string::npos);
  EXPECT_NE(problem_of([](hw_environment& p) { p.size = 8; }).find("8 bytes"), std::string::npos);
  EXPECT_NE(problem_of([](hw_environment& p) { p.force = nullptr; }).find("force"),
            std::string::npos);
  EXPECT_NE(problem_of([](hw_environment& p) { p.state_bytes = 1U << 30U; }).find("state"),
            std::string::npos);
  EXPECT_NE(problem_of([](hw_environment& p) { p.name = "walls"; }).find("already"),
            std::string::npos);
  EXPECT_NE(problem_of([](hw_environment& p) { p.name = "Upper"; }).find("name"),
            std::string::npos);
  EXPECT_NE(problem_of([](hw_environment& p) { p.idea = nullptr; }).find("one line"),
            std::string::npos);
  EXPECT_NE(problem_of([](hw_environment& p) { p.parameters = nullptr; }).find("NULL"),
            std::string::npos);
  static const hw_parameter kOther{"spacing_m", "N", 0.0, 1.0, 0.5, "another unit"};
  EXPECT_NE(problem_of([](hw_environment& p) { p.parameters = &kOther; }).find("another"),
            std::string::npos);
}

}  // namespace
}  // namespace hapticwall
