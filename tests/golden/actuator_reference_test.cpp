// The exact integrator in double against itself in long double, in closed loop: on the golden
// scenes, and on every combination of what lies between command and handle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/run/simulate.h"

namespace hapticwall {
namespace {

Scene golden(const std::string& name) {
  auto loaded = file::load_scene(name);
  EXPECT_TRUE(loaded.ok());
  return loaded->scene;
}

double largest_difference_m(const Scene& scene) {
  std::vector<double> ours;
  std::vector<double> reference;
  SimulationOptions options;
  options.on_sample = [&](const Sample& s) { ours.push_back(s.truth.position_m); };
  const SimulationResult run = simulate(scene, options);
  options.on_sample = [&](const Sample& s) { reference.push_back(s.truth.position_m); };
  const SimulationResult reference_run = simulate_reference(scene, options);
  EXPECT_EQ(ours.size(), scene.tick_count());
  EXPECT_EQ(reference.size(), scene.tick_count());
  EXPECT_EQ(run.summary.verdict, reference_run.summary.verdict);
  EXPECT_LE(std::abs(*reference_run.summary.energy_balance_error_j), 1e-17);
  double difference_m = 0.0;
  for (std::size_t k = 0; k < std::min(ours.size(), reference.size()); ++k) {
    difference_m = std::max(difference_m, std::abs(ours[k] - reference[k]));
  }
  return difference_m;
}

TEST(Reference, AgreesOnTheGoldenScenes) {
  for (const auto& [name, tolerance_m] : std::vector<std::pair<std::string, double>>{
           {"golden-soft", 1e-15}, {"golden-soft-fric", 1e-15}, {"golden-hard", 1e-14}}) {
    const double difference_m = largest_difference_m(golden(name));
    std::printf("%s: %.2g m\n", name.c_str(), difference_m);
    EXPECT_LE(difference_m, tolerance_m) << name;
  }
}

// Grip, friction, lag, delay.
using LoopParts = std::tuple<bool, bool, bool, bool>;
class ReferenceParts : public ::testing::TestWithParam<LoopParts> {};

TEST_P(ReferenceParts, AgreesInClosedLoop) {
  const auto [grip, friction, lag, delay] = GetParam();
  Scene scene = golden("golden-soft");
  if (grip) {
    scene.x().hand->grip_stiffness_n_per_m = 2000.0;
    scene.x().hand->grip_damping_n_s_per_m = 2.0;
  }
  if (friction) scene.x().device.friction_n = 0.14;
  if (lag) scene.x().device.amplifier_time_constant_s = 0.8e-3;
  if (delay) scene.x().device.delay_ticks = 2;
  const double difference_m = largest_difference_m(scene);
  std::printf("%.2g m\n", difference_m);
  EXPECT_LE(difference_m, 1e-15);
}

std::string name_of_parts(const LoopParts& parts) {
  std::string name = "plain";
  if (std::get<0>(parts)) name += "_grip";
  if (std::get<1>(parts)) name += "_friction";
  if (std::get<2>(parts)) name += "_lag";
  if (std::get<3>(parts)) name += "_delay";
  return name;
}

INSTANTIATE_TEST_SUITE_P(Combinations, ReferenceParts,
                         ::testing::Combine(::testing::Bool(), ::testing::Bool(), ::testing::Bool(),
                                            ::testing::Bool()),
                         [](const auto& param_info) { return name_of_parts(param_info.param); });

}  // namespace
}  // namespace hapticwall
