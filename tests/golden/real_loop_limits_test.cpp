// Limits of a bare wall under a controller that computes seldom, loses ticks, or has uneven
// periods. The numbers come from a program that shares no code with this one: eigenvalues of the
// loop and of its second moments. Mass 0.05 kg, b = 1 N·s/m, 1 kHz, no damper, no hand.
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <utility>

#include "core/run/simulate.h"
#include "core/study/stability_bounds.h"

namespace hapticwall {
namespace {

constexpr double kSixDigits = 5e-6;  // relative: the references have six

Scene bare_wall() {
  Scene scene;
  scene.x().device.mass_kg = 0.05;
  scene.x().device.damping_n_s_per_m = 1.0;
  scene.x().walls = {WallSettings{0.05, 1000.0, 0.0}};
  return scene;
}

void expect_limit(const Scene& scene, double reference_n_per_m) {
  const std::optional<double> limit = exact_stable_limit(scene);
  ASSERT_TRUE(limit);
  EXPECT_NEAR(*limit, reference_n_per_m, kSixDigits * reference_n_per_m);
}

TEST(RealLoopLimits, OfAForceOnEveryNthTick) {
  constexpr std::array kAtOnce{2006.69, 1006.71, 673.4,   506.756, 406.779,
                               340.134, 292.538, 256.846, 229.091, 206.892};
  constexpr std::array kATickLater{670.348, 504.127, 404.278, 337.744, 290.263,
                                   254.686, 227.042, 204.946, 186.883, 171.842};
  for (int every = 1; every <= 10; ++every) {
    Scene scene = bare_wall();
    scene.sampling.render_every = every;
    expect_limit(scene, kAtOnce.at(static_cast<std::size_t>(every) - 1));
    scene.x().device.delay_ticks = 1;
    expect_limit(scene, kATickLater.at(static_cast<std::size_t>(every) - 1));
  }
}

TEST(RealLoopLimits, OfLostTicksInTheMeanSquare) {
  for (const auto& [share, reference] : std::array<std::array<double, 2>, 4>{
           {{0.001, 2002.67}, {0.01, 1966.82}, {0.1, 1640.82}, {0.5, 667.389}}}) {
    Scene scene = bare_wall();
    scene.sampling.lost_ticks = share;
    expect_limit(scene, reference);
  }
}

TEST(RealLoopLimits, OfUnevenPeriodsInTheMeanSquare) {
  for (const auto& [jitter, reference] : std::array<std::array<double, 2>, 3>{
           {{0.1, 2000.06578}, {0.2, 1980.45908}, {0.5, 1853.37148}}}) {
    Scene scene = bare_wall();
    scene.sampling.jitter = jitter;
    expect_limit(scene, reference);
  }
}

// Without chance the second moments grow where the loop itself does.
TEST(RealLoopLimits, WithNextToNoChanceAreThoseOfTheLoopItself) {
  for (const double damping : {0.0, 5.0}) {
    for (const int delay : {0, 2}) {
      for (const int every : {1, 3}) {
        Scene scene = bare_wall();
        scene.x().walls.front().damping_n_s_per_m = damping;
        scene.x().device.delay_ticks = delay;
        scene.sampling.render_every = every;
        scene.x().hand = HandSettings{};
        scene.x().hand->mass_kg = 0.2;
        scene.x().hand->stiffness_n_per_m = 100.0;
        scene.x().hand->grip_stiffness_n_per_m = 400.0;
        const double regular = exact_stable_limit(scene).value();
        scene.sampling.jitter = 1e-9;
        EXPECT_NEAR(exact_stable_limit(scene).value(), regular, 1e-5 * regular)
            << damping << " " << delay << " " << every;
      }
    }
  }
}

// A soft hand presses the handle a millimetre into the wall, so that small swings stay in it. They
// begin with a micrometre.
Scene pressed(double stiffness_n_per_m) {
  constexpr double kPressM = 1e-3;
  constexpr double kSoft = 10.0;
  Scene scene = bare_wall();
  scene.x().walls.front().stiffness_n_per_m = stiffness_n_per_m;
  const double rest_m = scene.x().walls.front().position_m + kPressM;
  scene.x().device.start_m = rest_m + 1e-6;
  scene.x().hand = HandSettings{};
  scene.x().hand->stiffness_n_per_m = kSoft;
  scene.x().hand->path = {{0.0, rest_m + stiffness_n_per_m * kPressM / kSoft}};
  return scene;
}

// The mean over many seeds of v², at the end of a quarter of a second over that at its begin.
double growth(Scene scene) {
  constexpr int kSeeds = 400;
  scene.duration_s = 0.25;
  double first = 0.0;
  double last = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    scene.sampling.seed = seed;
    SimulationOptions options;
    options.on_sample = [&](const Sample& sample) {
      const double square = sample.truth.velocity_m_per_s * sample.truth.velocity_m_per_s;
      if (sample.tick < 50) first += square;
      if (sample.tick >= 200) last += square;
    };
    static_cast<void>(simulate(scene, options));
  }
  return last / first;
}

// The simulator knows no formula of the limit.
TEST(RealLoopLimits, PartRunsThatGrowFromRunsThatDecay) {
  Scene lost = bare_wall();
  lost.sampling.lost_ticks = 0.5;
  Scene uneven = bare_wall();
  uneven.sampling.jitter = 0.9;
  Scene seldom = bare_wall();
  seldom.sampling.render_every = 4;
  for (const Scene& loop : {lost, uneven, seldom}) {
    const double limit = exact_stable_limit(loop).value();
    for (const auto& [share, grows] : {std::pair(0.8, false), std::pair(1.25, true)}) {
      Scene scene = pressed(share * limit);
      scene.sampling = loop.sampling;
      EXPECT_EQ(growth(scene) > 1.0, grows) << limit << " " << share << " " << growth(scene);
    }
  }
}

}  // namespace
}  // namespace hapticwall
