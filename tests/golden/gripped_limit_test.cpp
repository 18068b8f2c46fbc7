// The limit of stability of a hand that holds the handle by a grip, against eigenvalues on a scan
// of stiffnesses. HAPTICWALL_GRIPPED_HANDS sets the number of random hands; docs/physics.md quotes
// a run with 10000.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "core/study/stability_bounds.h"
#include "tests/golden/loop_eigenvalues.h"

namespace hapticwall {
namespace {

using testing::LoopEigenvalues;
using testing::Random;

constexpr double kRatio = 1.04;  // between neighbours in the scan

bool is_stable(const LoopEigenvalues& loop, long double stiffness) {
  return loop.growth(stiffness) < 1.0L;
}

// Between a stable and an unstable wall.
double bisected(const LoopEigenvalues& loop, long double stable, long double unstable) {
  while (std::abs(unstable - stable) > 1e-10L * unstable) {
    const long double middle = 0.5L * (stable + unstable);
    (is_stable(loop, middle) ? stable : unstable) = middle;
  }
  return static_cast<double>(0.5L * (stable + unstable));
}

// The first unstable wall beyond `stable` if it lies within a step of the scan; otherwise 0.
double narrow_instability(const LoopEigenvalues& loop, double stable) {
  constexpr double kFiner = 1.1;
  for (double part = 1e-6; part < kRatio - 1.0; part *= kFiner) {
    const double stiffness = stable * (1.0 + part);
    if (!is_stable(loop, stiffness)) return bisected(loop, stable, stiffness);
  }
  return 0.0;
}

// The softest unstable wall. 0: even the softest are. `suspect`: the scan misses an instability
// that is narrower than a step, so the walls above this one are searched in finer steps.
double first_unstable(const LoopEigenvalues& loop, double suspect) {
  const long double unit = loop.unit_n_per_m();
  long double stable = 1e-8L * unit;
  while (!is_stable(loop, stable)) {
    stable *= 0.1L;
    if (stable < 1e-16L * unit) return 0.0;
  }
  long double next = stable * kRatio;
  // It ends, because every loop is unstable with a wall that is stiff enough.
  for (; is_stable(loop, next); next *= kRatio) stable = next;
  const double found = bisected(loop, stable, next);
  constexpr double kBefore = 1.0 - 1e-6;
  if (suspect <= 0.0 || suspect > kBefore * found || !is_stable(loop, kBefore * suspect)) {
    return found;
  }
  const double narrow = narrow_instability(loop, kBefore * suspect);
  return narrow > 0.0 ? narrow : found;
}

double limit_of(const Scene& scene, double delay_s) {
  LoopDelay delay = delay_of(scene);
  delay.transport_s = delay_s;
  return stability_bounds(scene, scene.x().walls[0], delay).stable_n_per_m.value();
}

Scene gripped(double mass_kg, double damping, HandSettings hand) {
  Scene scene;
  scene.x().device.mass_kg = mass_kg;
  scene.x().device.damping_n_s_per_m = damping;
  scene.x().hand = std::move(hand);
  scene.x().walls = {{0.05, 1000.0, 0.0}};
  return scene;
}

HandSettings grip(double stiffness, double damping, double mass_kg, double grip_stiffness,
                  double grip_damping) {
  return {mass_kg, stiffness, damping, grip_stiffness, grip_damping, {}, false};
}

// Two swings of these hands pass the circle at nearly the same place.
TEST(GrippedLimit, SeesCrossingsThatLieCloseTogether) {
  struct Row {
    Scene scene;
    double period_s;
    int delay_ticks;
    double limit_n_per_m;
  };
  const std::vector<Row> rows{
      {gripped(0.30447537476411546, 0.10084505140525754,
               grip(674.7052851597525, 2.1807825964692578, 0.3470040349761439, 1285.3436266744932,
                    19.667676020122737)),
       1e-3, 3, 652.7},
      {gripped(0.3697875184348522, 0.024880934824435555,
               grip(211.86321866433886, 1.4260271723405746, 0.2593917847747767, 675.026451077734,
                    0.35929760917672343)),
       1e-3, 3, 587.7},
      {gripped(0.6212890557417681, 0.18173367611299285,
               grip(54.183607767394236, 0.16291175599967564, 0.168461382298334, 252.83818833716987,
                    4.637654575160302)),
       4.416161648002981e-3, 0, 153.7},
      {gripped(0.18566660350199726, 0.02429517934410513,
               grip(936.453342630235, 0.5846671682882698, 0.7619319984848447, 636.2751551449606,
                    1.6648279137946278)),
       1e-3, 2, 269.7}};
  for (Row row : rows) {
    row.scene.sampling.rate_hz = 1.0 / row.period_s;
    const double delay_s = row.delay_ticks * row.scene.sampling.period_s();
    const double limit = limit_of(row.scene, delay_s);
    EXPECT_NEAR(limit, row.limit_n_per_m, 0.1);
    EXPECT_NEAR(limit / first_unstable({row.scene, delay_s}, limit), 1.0, 1e-9);
  }
}

// Every second hand has one more decade at either end of each range.
Scene random_scene(Random& random, int i) {
  const double more = i % 2 == 0 ? 1.0 : 10.0;
  const auto some = [&](double low, double high) { return random.ratio(low / more, high * more); };
  const double mass_kg = some(0.03, 1.0);
  const double damping = some(0.01, 5.0);
  const double stiffness = some(20.0, 2000.0);
  const double hand_damping = some(0.1, 40.0);
  const double hand_kg = some(0.05, 1.0);
  const double grip_stiffness = some(100.0, 5000.0);
  const double grip_damping = some(0.05, 20.0);
  Scene scene = gripped(mass_kg, damping,
                        grip(stiffness, hand_damping, hand_kg, grip_stiffness, grip_damping));
  if (i % 4 >= 2) scene.sampling.rate_hz = random.ratio(200.0, 10e3);
  if (i % 3 == 1) scene.x().device.amplifier_time_constant_s = random.ratio(0.03e-3, 3e-3);
  if (i % 5 >= 3) scene.x().walls[0].damping_n_s_per_m = random.ratio(0.01, 10.0);
  return scene;
}

// 0 to 5 ticks; every sixth ends within a tick.
double random_delay_s(Random& random, int i, const Scene& scene) {
  const double part = i % 6 == 5 ? random.between(0.0, 1.0) : 0.0;
  return std::min(5.0, random.upto(5) + part) * scene.sampling.period_s();
}

TEST(GrippedLimit, IsThatOfTheEigenvaluesForRandomHands) {
  const char* chosen = std::getenv("HAPTICWALL_GRIPPED_HANDS");  // NOLINT(concurrency-mt-unsafe)
  const int hands = chosen != nullptr ? std::stoi(chosen) : 40;
  Random random(20261124);
  double worst = 0.0;
  int without = 0;
  for (int i = 0; i < hands; ++i) {
    const Scene scene = random_scene(random, i);
    const double delay_s = random_delay_s(random, i, scene);
    const double limit = limit_of(scene, delay_s);
    const double expected = first_unstable({scene, delay_s}, limit);
    if (expected == 0.0) ++without;
    const double error = expected > 0.0 ? std::abs(limit / expected - 1.0) : limit;
    EXPECT_LT(error, 1e-6) << "hand " << i << ": " << limit << " N/m, expected " << expected;
    worst = std::max(worst, error);
  }
  RecordProperty("hands", hands);
  RecordProperty("without_a_stable_wall", without);
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

}  // namespace
}  // namespace hapticwall
