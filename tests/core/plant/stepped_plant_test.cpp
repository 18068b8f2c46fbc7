// The integrators with substeps: they converge to the exact motion at their order, and show what
// they are known to show.
#include "core/plant/stepped_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/plant/plant_model.h"
#include "core/run/simulate.h"

namespace hapticwall {
namespace {

Scene gripped() {
  Scene scene;
  scene.x().device.mass_kg = 0.05;
  scene.x().hand.emplace();
  scene.x().hand->mass_kg = 0.4;
  scene.x().hand->stiffness_n_per_m = 250.0;
  scene.x().hand->damping_n_s_per_m = 33.0;
  scene.x().hand->grip_stiffness_n_per_m = 1000.0;
  scene.x().hand->grip_damping_n_s_per_m = 1.0;
  scene.x().hand->path = {{0.0, 0.03}, {0.02, 0.035}};
  return scene;
}

Scene held() {
  Scene scene = gripped();
  scene.x().hand->mass_kg.reset();
  scene.x().hand->grip_stiffness_n_per_m.reset();
  scene.x().hand->grip_damping_n_s_per_m.reset();
  return scene;
}

Scene under(Scene scene, Integrator integrator, int substeps) {
  scene.simulator = {integrator, substeps};
  return scene;
}

// State after motion to and fro over fifty ticks.
PlantTruth moved(const Scene& scene) {
  PlantModel plant(scene);
  for (int tick = 0; tick < 50; ++tick) plant.advance((tick / 8) % 2 == 0 ? 2.0 : -1.0);
  return plant.truth();
}

double position_error(const Scene& scene, Integrator integrator, int substeps) {
  return std::abs(moved(under(scene, integrator, substeps)).position_m - moved(scene).position_m);
}

TEST(SteppedPlant, EulerConvergesAtFirstOrder) {
  for (const Scene& scene : {held(), gripped()}) {
    const double coarse = position_error(scene, Integrator::kSemiImplicitEuler, 50);
    const double fine = position_error(scene, Integrator::kSemiImplicitEuler, 100);
    EXPECT_GT(coarse, 1e-9);
    EXPECT_NEAR(coarse / fine, 2.0, 0.1);
  }
}

TEST(SteppedPlant, RungeKuttaConvergesAtFourthOrder) {
  for (const Scene& scene : {held(), gripped()}) {
    const double coarse = position_error(scene, Integrator::kRungeKutta4, 4);
    const double fine = position_error(scene, Integrator::kRungeKutta4, 8);
    EXPECT_GT(coarse, 1e-14);
    EXPECT_NEAR(coarse / fine, 16.0, 2.0);
  }
}

TEST(SteppedPlant, EnergiesConvergeToo) {
  for (const Scene& scene : {held(), gripped()}) {
    const PlantTruth exact = moved(scene);
    const PlantTruth euler = moved(under(scene, Integrator::kSemiImplicitEuler, 1000));
    const PlantTruth rk4 = moved(under(scene, Integrator::kRungeKutta4, 100));
    EXPECT_NEAR(rk4.actuator_work_j, exact.actuator_work_j, 1e-12);
    EXPECT_NEAR(rk4.dissipation_j, exact.dissipation_j, 1e-12);
    EXPECT_NEAR(rk4.hand_work_j, exact.hand_work_j, 1e-12);
    EXPECT_NEAR(euler.actuator_work_j, exact.actuator_work_j, 1e-5);
    EXPECT_NEAR(euler.dissipation_j, exact.dissipation_j, 1e-5);
    EXPECT_NEAR(euler.hand_work_j, exact.hand_work_j, 1e-5);
  }
}

TEST(SteppedPlant, FrictionStopsAndHoldsInBoth) {
  for (Scene scene : {held(), gripped()}) {
    scene.x().device.friction_n = 0.4;
    const PlantTruth exact = moved(scene);
    EXPECT_GT(exact.dissipation_j, 0.0);
    for (const Integrator integrator : {Integrator::kSemiImplicitEuler, Integrator::kRungeKutta4}) {
      const PlantTruth fine = moved(under(scene, integrator, 1000));
      EXPECT_NEAR(fine.position_m, exact.position_m, 2e-6);
      EXPECT_NEAR(fine.dissipation_j, exact.dissipation_j, 2e-5);
    }
  }
  Scene stuck = held();
  stuck.x().device.friction_n = 100.0;
  for (const Integrator integrator : {Integrator::kSemiImplicitEuler, Integrator::kRungeKutta4}) {
    EXPECT_EQ(moved(under(stuck, integrator, 3)).position_m, stuck.x().device.start_m);
  }
}

TEST(SteppedPlant, BendsOfThePathAreFollowed) {
  Scene scene = held();
  scene.x().hand->path = {{0.0, 0.03}, {0.0125, 0.036}, {0.0205, 0.031}};
  EXPECT_LT(position_error(scene, Integrator::kRungeKutta4, 20), 1e-12);
}

// The sampled spring's map under semi-implicit Euler with one step per tick conserves energy, where
// a real hold feeds it: the limit cycle of a stiff wall is not there.
TEST(SteppedPlant, EulerWithOneStepATickHidesTheLimitCycle) {
  Scene scene;
  scene.duration_s = 3.0;
  scene.x().device.mass_kg = 0.2;
  scene.x().device.force_limit_n = 8.9;
  scene.x().hand.emplace();
  scene.x().hand->stiffness_n_per_m = 300.0;
  scene.x().hand->damping_n_s_per_m = 5.0;
  scene.x().hand->path = {{0.0, 0.03}, {0.3, 0.06}};
  scene.x().walls = {{0.05, 35e3, 0.0}};
  const auto peak_to_peak_m = [&](Integrator integrator, int substeps) {
    return simulate(under(scene, integrator, substeps)).summary.tail_peak_to_peak_m.value();
  };
  const double exact = peak_to_peak_m(Integrator::kExact, 1);
  EXPECT_GT(exact, 0.9e-3);
  EXPECT_LT(peak_to_peak_m(Integrator::kSemiImplicitEuler, 1), 1e-9);
  EXPECT_NEAR(peak_to_peak_m(Integrator::kSemiImplicitEuler, 200), exact, 0.01 * exact);
  EXPECT_NEAR(peak_to_peak_m(Integrator::kRungeKutta4, 1), exact, 1e-4 * exact);
}

TEST(SteppedPlant, AnUnstableChoiceDivergesInGoodOrder) {
  Scene scene = held();
  scene.x().device.mass_kg = 1e-4;
  scene.x().device.damping_n_s_per_m = 10.0;  // b h/m = 100
  const SimulationResult result = simulate(under(scene, Integrator::kSemiImplicitEuler, 1));
  EXPECT_EQ(result.summary.verdict, Verdict::kDiverged);
  EXPECT_TRUE(result.summary.diverged_at_tick.has_value());
  EXPECT_NE(simulate(scene).summary.verdict, Verdict::kDiverged);
}

}  // namespace
}  // namespace hapticwall
