// Delay, lag and resolution by what can be said of them in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/plant/output_stage.h"
#include "core/plant/plant_model.h"
#include "core/run/simulate.h"
#include "tests/samples.h"

namespace hapticwall {
namespace {

// e^(-z) less the first `terms` of its series, by the rest of the series where that would cancel.
long double exponential_rest(long double z, int terms) {
  constexpr int kMaxTerms = 40;
  long double term = 1.0L;
  long double first = 0.0L;
  long double rest = 0.0L;
  for (int n = 0; n < kMaxTerms; ++n) {
    (n < terms ? first : rest) += term;
    term *= -z / static_cast<long double>(n + 1);
  }
  return z < 1.0L ? rest : std::exp(-z) - first;
}

// A free mass under F_a = F (1 - e^(-t/τ)), F_a(0) = 0:
//   v = -F τ/m (e^(-z) - 1 + z),   x = F τ²/m (e^(-z) - 1 + z - z²/2),   z = t/τ.
// What acts is then a fraction t/τ of the command and known to the last digit of that: a lag that
// is long keeps as many digits less.
TEST(AmplifierLag, MovesAFreeMassAsItsStepResponseSays) {
  constexpr double kForceN = 2.0;
  constexpr double kMassKg = 0.2;
  constexpr double kDigits = 1e-14;
  constexpr double kLastDigit = std::numeric_limits<double>::epsilon();
  for (const double tau_s : {1e-9, 1e-4, 1e-3, 0.02, 10.0}) {
    Scene scene;
    scene.x().device.mass_kg = kMassKg;
    scene.x().device.damping_n_s_per_m = 0.0;
    scene.x().device.start_m = 0.0;
    scene.x().device.amplifier_time_constant_s = tau_s;
    PlantModel plant(scene);
    const long double tau = tau_s;
    const long double rate = tau * static_cast<long double>(kForceN) / kMassKg;
    for (int tick = 1; tick <= 100; ++tick) {
      plant.advance(kForceN);
      const long double z = static_cast<long double>(tick) / 1000.0L / tau;
      const auto v = static_cast<double>(-rate * exponential_rest(z, 2));
      const auto x = static_cast<double>(rate * tau * exponential_rest(z, 3));
      const double within = kDigits + kLastDigit * static_cast<double>(1.0L / z);
      const PlantTruth& truth = plant.truth();
      ASSERT_NEAR(truth.velocity_m_per_s, v, within * std::abs(v)) << tau_s << ' ' << tick;
      ASSERT_NEAR(truth.position_m, x, within * std::abs(x)) << tau_s << ' ' << tick;
      // All work of the actuator is in the motion, of whose energy the speed counts twice.
      ASSERT_NEAR(truth.actuator_work_j, -truth.kinetic_j, 2.0 * within * truth.kinetic_j)
          << tau_s << ' ' << tick;
    }
  }
}

Scene wall_scene() {
  Scene scene;
  scene.duration_s = 1.0;
  scene.x().device.mass_kg = 0.2;
  scene.x().device.force_limit_n = 8.9;
  scene.x().hand.emplace();
  scene.x().hand->stiffness_n_per_m = 300.0;
  scene.x().hand->damping_n_s_per_m = 5.0;
  scene.x().hand->path = {{0.0, 0.03}, {0.3, 0.06}};
  scene.x().walls = {{.position_m = 0.05, .stiffness_n_per_m = 1000.0}};
  return scene;
}

// The command of exactly that many ticks ago moves the plant, and nothing before the first.
TEST(OutputDelay, ShiftsTheForceByExactlyItsTicks) {
  for (const int delay : {0, 1, 7, 100, 1000}) {
    for (const bool grip : {false, true}) {
      Scene scene = wall_scene();
      if (grip) {
        scene.x().hand->mass_kg = 0.2;
        scene.x().hand->grip_stiffness_n_per_m = 2000.0;
      }
      scene.x().device.delay_ticks = delay;
      const std::vector<Sample> samples = testing::samples_of(scene);
      ASSERT_GT(samples.size(), 100U);
      Scene plain = scene;
      plain.x().device.delay_ticks.reset();
      PlantModel plant(plain);
      double most_n = 0.0;
      for (std::size_t k = 0; k < samples.size(); ++k) {
        ASSERT_EQ(samples[k].truth.position_m, plant.truth().position_m) << k;
        ASSERT_EQ(samples[k].truth.actuator_work_j, plant.truth().actuator_work_j) << k;
        const auto before = static_cast<std::size_t>(delay);
        plant.advance(k < before ? 0.0 : samples[k - before].force_n);
        most_n = std::max(most_n, samples[k].force_n);
      }
      EXPECT_GT(most_n, 1.0);
    }
  }
}

double passed(double resolution_n, double limit_n, double command_n) {
  Scene scene;
  scene.x().device.force_resolution_n = resolution_n;
  scene.x().device.force_limit_n = limit_n;
  OutputStage output(scene);
  return output.pass(command_n);
}

TEST(ForceResolution, RoundsToWholeMultiplesAndTiesToEven) {
  for (const double side : {1.0, -1.0}) {
    EXPECT_EQ(passed(0.25, 8.9, side * 0.125), side * 0.0);
    EXPECT_EQ(passed(0.25, 8.9, side * 0.375), side * 0.5);
    EXPECT_EQ(passed(0.25, 8.9, side * 0.625), side * 0.5);
    EXPECT_EQ(passed(0.25, 8.9, side * 0.875), side * 1.0);
    EXPECT_EQ(passed(0.25, 8.9, side * 0.626), side * 0.75);
    EXPECT_EQ(passed(0.25, 8.9, side * 0.124), side * 0.0);
    EXPECT_EQ(passed(1e3, 8.9, side * 8.9), side * 0.0);
    EXPECT_EQ(passed(1e-12, 8.9, side * 8.9), side * 8.9);
  }
}

TEST(ForceResolution, RoundingUpDoesNotExceedTheLimit) {
  EXPECT_EQ(passed(5.0, 8.9, 8.9), 8.9);
  EXPECT_EQ(passed(5.0, 8.9, -8.9), -8.9);
  EXPECT_EQ(passed(5.0, 0.0, 0.0), 0.0);
}

// The recorded force and the ledger are the command; what acts is rounded.
TEST(ForceResolution, TheLedgerHoldsTheCommandAndThePlantTheRoundedForce) {
  Scene scene = wall_scene();
  scene.x().device.force_resolution_n = 0.5;
  const std::vector<Sample> samples = testing::samples_of(scene);
  double scv_j = 0.0;
  double work_j = 0.0;
  bool between = false;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double command_n = samples[k - 1].force_n;
    const double acting_n = 0.5 * std::nearbyint(command_n / 0.5);
    between = between || command_n != acting_n;
    const double step_m = samples[k].truth.position_m - samples[k - 1].truth.position_m;
    scv_j += command_n * step_m;
    work_j += acting_n * step_m;
    EXPECT_NEAR(samples[k].energy_scv_j, scv_j, 1e-15);
    EXPECT_NEAR(samples[k].truth.actuator_work_j, work_j, 1e-14);
  }
  EXPECT_TRUE(between);
  EXPECT_GT(std::abs(scv_j - work_j), 1e-6);
}

}  // namespace
}  // namespace hapticwall
