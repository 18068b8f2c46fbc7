// The built-in scenes again, by a program that someone else would write to check this one: the
// equations of motion integrated by brute force in extended precision, the walls, the algorithms
// and the ledger written out straight from their formulas. Nothing but the scene's numbers is
// shared.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/golden/brute_force_tap.h"

namespace hapticwall {
namespace {

using testing::BruteForcePlant;
using testing::ReferenceScene;
using testing::ReferenceState;

constexpr double kWall = 0.05;

struct Figures {
  double peak_to_peak_m = 0.0;
  double force_mean_n = 0.0;
  double force_std_n = 0.0;
  double stiffness_n_per_m = 0.0;
  double cv_j = 0.0;
  double hold_j = 0.0;
  double scv_j = 0.0;
  double hand_work_j = 0.0;
};

BruteForcePlant plant_of(const std::string& scene) {
  if (scene == "tap") return testing::tap_plant(0.2L);
  if (scene == "tap-slow") return testing::tap_plant(0.03L);
  if (scene == "light") {
    BruteForcePlant plant = testing::paper_plant(0.1L, 0.06L);
    plant.hand_stiffness = 400.0L;
    return plant;
  }
  BruteForcePlant plant = testing::paper_plant(0.03L, 0.075L);
  plant.hand_mass = 0.4L;
  plant.hand_stiffness = 250.0L;
  plant.hand_damping = 33.0L;
  plant.grip_stiffness = 1000.0L;
  plant.grip_damping = 1.0L;
  return plant;
}

Figures brute_force(const std::string& scene, const std::string& algorithm) {
  BruteForcePlant plant = plant_of(scene);
  const ReferenceScene controller = testing::paper_controller();
  ReferenceState state;
  Figures out;
  double force = 0.0;
  double previous_x = 0.0;
  double least = 1.0;
  double most = -1.0;
  double penetrations = 0.0;
  double contact_forces = 0.0;
  std::vector<double> tail;
  for (int k = 0; k < testing::kPaperTicks; ++k) {
    const double x = testing::measured_m(plant);
    const double dx = k == 0 ? 0.0 : x - previous_x;
    const double p = x - kWall;
    const double next = testing::reference_force(algorithm, controller, state, x);
    out.cv_j += next * dx;
    out.hold_j += (force - next) * dx;
    out.scv_j += force * dx;
    force = next;
    previous_x = x;
    if (k >= testing::kPaperTicks - testing::kPaperTail) {
      least = std::min(least, static_cast<double>(plant.x));
      most = std::max(most, static_cast<double>(plant.x));
      tail.push_back(force);
      if (p > 0.0) {
        penetrations += p;
        contact_forces += force;
      }
    }
    plant.advance(force, testing::kPaperPeriodS, testing::kPaperSubsteps);
  }
  out.peak_to_peak_m = most - least;
  for (const double f : tail) out.force_mean_n += f / static_cast<double>(tail.size());
  double square = 0.0;
  for (const double f : tail) square += std::pow(f - out.force_mean_n, 2);
  out.force_std_n = std::sqrt(square / static_cast<double>(tail.size()));
  out.stiffness_n_per_m = contact_forces / penetrations;
  out.hand_work_j = static_cast<double>(plant.hand_work);
  return out;
}

class BruteForceScene : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(BruteForceScene, Agrees) {
  const std::string scene_name = std::get<0>(GetParam());
  const std::string algorithm = std::get<1>(GetParam());
  auto loaded = file::load_scene(scene_name);
  ASSERT_TRUE(loaded.ok());
  loaded->scene.algorithm.index = find_algorithm(algorithm).value();
  const Summary ours = simulate(loaded->scene).summary;
  const Figures reference = brute_force(scene_name, algorithm);
  const bool settled = reference.peak_to_peak_m <= 1e-4;
  EXPECT_EQ(ours.verdict, settled ? Verdict::kSettled : Verdict::kOscillating);
  constexpr double kWithin = 1e-4;
  const auto expect_near = [&](double measured, double expected, double floor, const char* what) {
    EXPECT_NEAR(measured, expected, kWithin * std::abs(expected) + floor) << what;
  };
  expect_near(ours.tail_peak_to_peak_m.value(), reference.peak_to_peak_m, 1e-7, "peak to peak");
  expect_near(ours.tail_force_mean_n.value(), reference.force_mean_n, 0.0, "force");
  expect_near(ours.tail_force_std_n.value(), reference.force_std_n, 1e-4, "std of force");
  expect_near(ours.displayed_stiffness_n_per_m.value_or(0.0), reference.stiffness_n_per_m, 0.0,
              "stiffness");
  expect_near(ours.energy_cv_j, reference.cv_j, 1e-6, "energy_cv");
  expect_near(ours.energy_hold_j, reference.hold_j, 1e-6, "energy_hold");
  expect_near(ours.energy_scv_j, reference.scv_j, 1e-6, "energy_scv");
  expect_near(ours.true_hand_work_j.value_or(0.0), reference.hand_work_j, 1e-6, "hand work");
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, BruteForceScene,
    ::testing::Combine(::testing::Values("press", "tap", "tap-slow", "light"),
                       ::testing::Values("none", "virtual-coupling", "passivity-control",
                                         "energy-bounding", "energy-bounding-2010",
                                         "force-bounding", "half-sample", "energy-limited-spring")),
    [](const auto& test) {
      std::string name = std::string(std::get<0>(test.param)) + "_" + std::get<1>(test.param);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace hapticwall
