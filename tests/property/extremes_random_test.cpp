// Thousands of random scenes at the extremes of every key: nothing is ever not finite, nothing
// exceeds the force limit, every run ends in good order, and the exact integrator closes its
// balance.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/property/extremes_run.h"

namespace hapticwall {
namespace {

using testing::Draw;
using testing::expect_sound;
using testing::extreme_scene;
using testing::kPromisedBalance;
using testing::promised_balance;

TEST(ExtremeScenes, AreSoundUnderTheExactIntegrator) {
  constexpr std::uint64_t kScenes = 12000;
  int refused = 0;
  int beyond_domain = 0;
  int beyond_promise = 0;
  double worst_within = 0.0;
  double worst = 0.0;
  for (std::uint64_t number = 0; number < kScenes; ++number) {
    SCOPED_TRACE(number);
    const Scene scene = extreme_scene(number);
    double error = 0.0;
    try {
      error = expect_sound(scene);
    } catch (const SimulationRefused&) {
      ++refused;
      continue;
    }
    const bool within = promised_balance(scene) <= kPromisedBalance;
    beyond_domain += within ? 0 : 1;
    beyond_promise += error > kPromisedBalance ? 1 : 0;
    worst = std::max(worst, error);
    if (within) worst_within = std::max(worst_within, error);
    if (HasFailure()) break;
  }
  std::printf(
      "balance of %d scenes: at worst %.2g of the turnover in the domain of 1e-9; %d scenes beyond "
      "it, of which %d keep less than 1e-9, at worst %.2g; %d refused\n",
      static_cast<int>(kScenes), worst_within, beyond_domain, beyond_promise, worst, refused);
  EXPECT_LE(refused, static_cast<int>(kScenes) / 100);
  // Digits are hardly ever lost, even beyond the domain.
  EXPECT_LE(beyond_promise, beyond_domain / 100);
  EXPECT_LE(worst, 1e-3);
}

void expect_sound_under(Integrator integrator) {
  constexpr std::uint64_t kScenes = 2500;
  for (std::uint64_t number = 0; number < kScenes; ++number) {
    SCOPED_TRACE(number);
    Scene scene = extreme_scene(number);
    Draw draw(~number);
    scene.simulator = {integrator, static_cast<int>(draw.log_uniform(1.0, kMaxSubsteps))};
    (void)expect_sound(scene);
    if (::testing::Test::HasFailure()) break;
  }
}
TEST(ExtremeScenes, AreSoundUnderSemiImplicitEuler) {
  expect_sound_under(Integrator::kSemiImplicitEuler);
}
TEST(ExtremeScenes, AreSoundUnderRungeKutta) { expect_sound_under(Integrator::kRungeKutta4); }

TEST(ExtremeScenes, AreSoundWithUnevenPeriods) {
  constexpr std::uint64_t kScenes = 2000;
  for (std::uint64_t number = 0; number < kScenes; ++number) {
    SCOPED_TRACE(number);
    Scene scene = extreme_scene(number);
    scene.sampling.jitter = Draw(~number).log_uniform(1e-9, 0.99);
    try {
      const testing::ExtremeRun run = testing::run_watched(scene);
      EXPECT_TRUE(run.finite && run.within_limit) << testing::scene_text(scene);
      EXPECT_TRUE(testing::ended_in_good_order(scene, run)) << testing::scene_text(scene);
    } catch (const SimulationRefused&) {
      continue;
    }
    if (HasFailure()) break;
  }
}

// The scenes themselves: what they are said to reach they reach.
TEST(ExtremeScenes, ReachEveryExtreme) {
  int frictions = 0;
  int grips = 0;
  int lags = 0;
  int delays = 0;
  int single_ticks = 0;
  int starts_on_a_wall = 0;
  int tiny_slopes = 0;
  double stiffest = 0.0;
  constexpr std::uint64_t kScenes = 3000;
  for (std::uint64_t number = 0; number < kScenes; ++number) {
    const Scene scene = extreme_scene(number);
    frictions += scene.x().device.friction_n.value_or(0.0) > 0.0 ? 1 : 0;
    lags += scene.x().device.amplifier_time_constant_s.value_or(0.0) > 0.0 ? 1 : 0;
    delays += scene.x().device.delay_ticks.value_or(0) > 0 ? 1 : 0;
    single_ticks += scene.tick_count() == 1 ? 1 : 0;
    for (const WallSettings& wall : scene.x().walls) {
      starts_on_a_wall += wall.position_m == scene.x().device.start_m ? 1 : 0;
      stiffest = std::max(stiffest, wall.stiffness_n_per_m);
    }
    if (!scene.x().hand) continue;
    grips += scene.x().hand->has_grip() ? 1 : 0;
    for (std::size_t i = 1; i < scene.x().hand->path.size(); ++i) {
      const double move_m =
          scene.x().hand->path[i].position_m - scene.x().hand->path[i - 1].position_m;
      tiny_slopes += move_m != 0.0 && std::abs(move_m) < 1e-199 ? 1 : 0;
    }
  }
  for (const int count :
       {frictions, grips, lags, delays, single_ticks, starts_on_a_wall, tiny_slopes}) {
    EXPECT_GE(count, 50);
  }
  EXPECT_GT(stiffest, 5e8);
}

}  // namespace
}  // namespace hapticwall
