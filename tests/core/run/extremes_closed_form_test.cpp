// Plants whose eigenvalues coincide or nearly do, or that are nearly singular, lose no digits: the
// plant against a power series in 113 bits, and the closed loop against itself in long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <variant>
#include <vector>

#include "core/plant/plant_model.h"
#include "core/run/simulate.h"
#include "tests/quad_plant.h"
#include "tests/samples.h"

namespace hapticwall {
namespace {

using testing::Quad;
using testing::QuadPlant;

constexpr double kLastDigits = 1e-14;
constexpr int kClosedFormTicks = 40;
constexpr double kSpeed = 0.01;

// Everything in powers of two, so that what is meant to be critical is so to the last bit: b + b_h
// = 2 sqrt(k m).
Scene critical(double ratio) {
  Scene scene;
  scene.sampling.rate_hz = 16.0;
  scene.x().device.mass_kg = 1.0;
  scene.x().device.damping_n_s_per_m = 1.0;
  scene.x().device.start_m = 0.0;
  scene.x().hand.emplace();
  scene.x().hand->stiffness_n_per_m = 16.0;
  scene.x().hand->damping_n_s_per_m = 8.0 * ratio - 1.0;
  scene.x().hand->path = {{0.0, 0.0}, {50.0, kSpeed * 50.0}};
  return scene;
}

struct Nearly {
  std::string name;
  Scene scene;
};

std::vector<Nearly> singular_scenes() {
  std::vector<Nearly> all;
  for (const double offset : {0.0, 1e-12, -1e-12, 1e-6, -1e-6}) {
    all.push_back({"critical" + std::to_string(offset * 1e12), critical(1.0 + offset)});
  }
  for (const double small : {0.0, 1e-300, 1e-12, 1e-6}) {
    Scene soft = critical(1.0);
    soft.x().hand->stiffness_n_per_m = small;
    all.push_back({"soft", soft});
    Scene undamped = critical(1.0);
    undamped.x().device.damping_n_s_per_m = small;
    undamped.x().hand->damping_n_s_per_m = 0.0;
    all.push_back({"undamped", undamped});
    Scene nothing = undamped;
    nothing.x().hand->stiffness_n_per_m = small;
    all.push_back({"free", nothing});
  }
  return all;
}

// The amplifier's rate is that of the critical hand: a threefold eigenvalue.
Scene with_equal_lag(Scene scene) {
  scene.x().device.amplifier_time_constant_s = 0.25;
  return scene;
}
// Hand and grip of the same rates, critical each.
Scene with_grip(Scene scene) {
  scene.x().hand->mass_kg = 1.0;
  scene.x().hand->grip_stiffness_n_per_m = scene.x().hand->stiffness_n_per_m;
  scene.x().hand->grip_damping_n_s_per_m = scene.x().hand->damping_n_s_per_m;
  return scene;
}

double command(int tick) { return tick % 8 < 4 ? 0.5 : -0.25; }

struct Errors {
  double position = 0.0;  // relative to the largest, as all that follow
  double velocity = 0.0;
  double energy = 0.0;
};

double off(Quad ours, Quad reference) {
  return static_cast<double>(ours > reference ? ours - reference : reference - ours);
}

template <typename Plant>
Errors compare(const Scene& scene, Plant& plant) {
  QuadPlant reference(scene);
  Errors error;
  double most_m = 0.0;
  double most_m_per_s = 0.0;
  double most_j = 0.0;
  const double period_s = scene.sampling.period_s();
  for (int tick = 0; tick < kClosedFormTicks; ++tick) {
    plant.advance(command(tick));
    reference.advance(command(tick), kSpeed * period_s * tick, kSpeed, period_s);
    const auto motion = plant.motion();
    error.position = std::max(error.position, off(motion.body.position_m, reference.x));
    error.velocity = std::max(error.velocity, off(motion.body.velocity_m_per_s, reference.v));
    error.energy =
        std::max({error.energy, off(motion.energy.actuator_work_j, reference.actuator_work),
                  off(motion.energy.viscous_j, reference.dissipation),
                  off(motion.energy.hand_work_j, reference.hand_work),
                  off(plant.kinetic_j(), reference.kinetic())});
    most_m = std::max(most_m, std::abs(static_cast<double>(reference.x)));
    most_m_per_s = std::max(most_m_per_s, std::abs(static_cast<double>(reference.v)));
    most_j = std::max({most_j, std::abs(static_cast<double>(reference.actuator_work)),
                       std::abs(static_cast<double>(reference.hand_work)),
                       static_cast<double>(reference.kinetic())});
  }
  return {error.position / most_m, error.velocity / most_m_per_s, error.energy / most_j};
}

void expect_all_digits(const std::string& name, const Scene& scene) {
  SCOPED_TRACE(name);
  auto plants = make_plant(scene);
  const Errors error = std::visit([&](auto& plant) { return compare(scene, plant); }, plants);
  EXPECT_LE(error.position, kLastDigits);
  EXPECT_LE(error.velocity, kLastDigits);
  EXPECT_LE(error.energy, kLastDigits);
  auto references = make_reference_plant(scene);
  const Errors finer = std::visit([&](auto& plant) { return compare(scene, plant); }, references);
  constexpr double kLongDigits = 1e-17;
  EXPECT_LE(finer.position, kLongDigits);
  EXPECT_LE(finer.velocity, kLongDigits);
  EXPECT_LE(finer.energy, kLongDigits);
  std::printf("%-16s %.1e %.1e %.1e   in long double %.1e %.1e %.1e\n", name.c_str(),
              error.position, error.velocity, error.energy, finer.position, finer.velocity,
              finer.energy);
}

TEST(NearlySingularPlants, OneBodyLosesNoDigits) {
  for (const Nearly& each : singular_scenes()) expect_all_digits(each.name, each.scene);
}
TEST(NearlySingularPlants, OneBodyWithALagOfTheSameRateLosesNoDigits) {
  for (const Nearly& each : singular_scenes()) {
    expect_all_digits(each.name, with_equal_lag(each.scene));
  }
}
TEST(NearlySingularPlants, AGrippedHandleLosesNoDigits) {
  for (const Nearly& each : singular_scenes()) {
    expect_all_digits(each.name, with_grip(each.scene));
    expect_all_digits(each.name + ", lag", with_equal_lag(with_grip(each.scene)));
  }
}

// The textbook's closed form of the critically damped step response, by itself.
TEST(NearlySingularPlants, TheCriticalStepResponseIsTheTextbooks) {
  Scene scene = critical(1.0);
  scene.x().hand->path = {{0.0, 0.5}};
  PlantModel plant(scene);
  constexpr long double kRate = 4.0L;
  for (int tick = 1; tick <= kClosedFormTicks; ++tick) {
    plant.advance(0.0);
    // F_h = k(p - x) - b_h v with b_h + b = 2 m rate, so that x = p (1 - (1 + rate t) e^(-rate t)).
    const long double t = static_cast<long double>(tick) / 16.0L;
    const long double x = 0.5L * (1.0L - (1.0L + kRate * t) * std::exp(-kRate * t));
    EXPECT_NEAR(plant.truth().position_m, static_cast<double>(x), kLastDigits * 0.5);
  }
}

// The loop is closed with a wall that the sampling carries, over its whole run.
TEST(NearlySingularPlants, TheClosedLoopLosesNoDigits) {
  for (const Nearly& each : singular_scenes()) {
    for (Scene scene : {each.scene, with_equal_lag(each.scene), with_grip(each.scene)}) {
      SCOPED_TRACE(each.name);
      scene.duration_s = 10.0;
      scene.sampling.rate_hz = 64.0;
      scene.x().walls = {{.position_m = 0.02, .stiffness_n_per_m = 4.0}};
      scene.x().hand->path = {{0.0, 0.0}, {4.0, 0.08}};
      const std::vector<Sample> ours = testing::samples_of(scene);
      const auto reference = testing::samples_of(scene, {}, simulate_reference);
      ASSERT_EQ(ours.size(), reference.size());
      double max_m = 0.0;
      for (const Sample& sample : reference) {
        max_m = std::max(max_m, std::abs(sample.truth.position_m));
      }
      EXPECT_LE(testing::max_distance_m(ours, reference), kLastDigits * max_m);
    }
  }
}

}  // namespace
}  // namespace hapticwall
