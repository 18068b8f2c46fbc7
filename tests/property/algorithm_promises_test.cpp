// Every algorithm keeps what its formula promises: in closed loops with random devices, hands and
// walls, and against an adversary who moves the handle as is worst for it.
#include "tests/property/algorithm_promises.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "core/run/simulate.h"
#include "tests/position_bench.h"
#include "tests/property/scene_generator.h"
#include "tests/samples.h"

namespace hapticwall {
namespace {

using testing::flip;
using testing::log_uniform;
using testing::random_scene;
using testing::set_parameter;
using testing::Trial;

constexpr std::size_t kPromiseTicks = 2000;
constexpr double kNoLimit = std::numeric_limits<double>::max();

ServoSettings random_settings(std::string_view algorithm) {
  Scene scene = random_scene(algorithm);
  if (flip()) scene.x().device.force_limit_n.reset();
  if (flip()) set_parameter(scene.algorithm, "damping_n_s_per_m", log_uniform(0.01, 20.0));
  ServoSettings settings = servo_settings(scene);
  const double most = testing::max_storage_stiffness(settings);
  if (flip() && most > 1.0) {
    set_parameter(settings.algorithm, "storage_stiffness_n_per_m", log_uniform(1.0, most));
  }
  return settings;
}

Trial attacked(const ServoSettings& settings) {
  return {settings, testing::attack(settings, *rc::gen::arbitrary<std::uint64_t>(), kPromiseTicks)};
}

// A scene that is nothing but these settings with a hand.
Scene scene_of(const ServoSettings& settings) {
  Scene scene = random_scene("none");
  scene.sampling.rate_hz = settings.rate_hz;
  scene.x().device.damping_n_s_per_m = settings.device_damping_n_s_per_m;
  scene.x().device.encoder_m.reset();
  if (settings.encoder_m > 0.0) scene.x().device.encoder_m = settings.encoder_m;
  scene.x().device.force_limit_n.reset();
  if (settings.force_limit_n < kNoLimit) scene.x().device.force_limit_n = settings.force_limit_n;
  const auto walls = settings.walls.walls();
  scene.x().walls.assign(walls.begin(), walls.end());
  scene.algorithm = settings.algorithm;
  return scene;
}

template <typename Promise>
void is_kept(const ServoSettings& settings, Promise&& promise) {
  const Trial hard = attacked(settings);
  testing::forces_are_finite_and_within_the_limit(hard);
  promise(hard);
  const Scene scene = scene_of(settings);
  const Trial loop{servo_settings(scene), testing::samples_of(scene)};
  testing::forces_are_finite_and_within_the_limit(loop);
  promise(loop);
}

RC_GTEST_PROP(EnergyBoundingPromise, TheChangeOfForceIsBounded, ()) {
  is_kept(random_settings("energy-bounding"), testing::energy_bounding_keeps_its_bound);
}

RC_GTEST_PROP(EnergyBounding2010Promise, HoldAndControlLawPayForThemselves, ()) {
  is_kept(random_settings("energy-bounding-2010"), testing::energy_bounding_2010_keeps_its_bounds);
}

RC_GTEST_PROP(ForceBoundingPromise, NothingIsOwedWhateverTheNextMove, ()) {
  is_kept(random_settings("force-bounding"), testing::force_bounding_never_owes);
}

RC_GTEST_PROP(HalfSamplePromise, IsTheWallHalfATickAhead, ()) {
  ServoSettings settings = random_settings("half-sample");
  std::vector<WallSettings> walls(settings.walls.walls().begin(), settings.walls.walls().end());
  if (flip()) walls.front().damping_n_s_per_m = log_uniform(0.01, 30.0);
  if (flip()) walls.push_back({0.052, log_uniform(100.0, 1e5), 0.0});
  settings.walls = WallSet(walls);
  is_kept(settings, testing::half_sample_is_half_a_tick_ahead);
}

RC_GTEST_PROP(EnergyLimitedSpringPromise, TheBookStaysAboveItsFloor, ()) {
  ServoSettings settings = random_settings("energy-limited-spring");
  settings.force_limit_n = kNoLimit;
  is_kept(settings, testing::energy_limited_spring_keeps_its_floor);
}

RC_GTEST_PROP(EnergyLimitedSpringPromise, TwoWallsInOnePlaceAreOneOfBoth, ()) {
  ServoSettings settings = random_settings("energy-limited-spring");
  WallSettings wall = settings.walls.walls().front();
  const std::vector<WallSettings> halves(2, {wall.position_m, wall.stiffness_n_per_m / 2.0, 0.0});
  ServoSettings layered = settings;
  layered.walls = WallSet(halves);
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const auto one = testing::attack(settings, seed, kPromiseTicks);
  const auto two = testing::attack(layered, seed, kPromiseTicks);
  for (std::size_t k = 0; k < kPromiseTicks; ++k) RC_ASSERT(one[k].force_n == two[k].force_n);
}

// Force that energy-bounding asked for in each row: its only state is the last force.
std::vector<double> wanted_by_energy_bounding(const Trial& trial) {
  std::vector<double> wanted_n;
  ActiveAlgorithm first;
  first.configure(trial.settings.algorithm.index, algorithm_context(trial.settings));
  double before_n = 0.0;
  double before_m = trial.rows.front().position_m;
  for (const Sample& row : trial.rows) {
    AlgorithmInput input;
    input.wall_force_n = row.wall_force_n;
    input.displacement_m = row.position_m - std::exchange(before_m, row.position_m);
    input.velocity_m_per_s = row.velocity_m_per_s;
    input.previous_force_n = before_n;
    wanted_n.push_back(first.step(input));
    before_n = row.force_n;
  }
  return wanted_n;
}

// With the same-sample and the one-step observer the passivity controller takes the missing energy
// unless its cap is reached. It acts as a follower of energy-bounding, whose control law lags and
// is therefore active.
void follower_takes_what_is_missing(bool credit, bool one_step = false) {
  ServoSettings settings = random_settings("energy-bounding");
  settings.force_limit_n = kNoLimit;
  const double cap = log_uniform(0.1, 1e5);
  set_parameter(settings.algorithm, "then", 1.0);
  set_parameter(settings.algorithm, "max_damping_n_s_per_m", cap);
  if (credit) set_parameter(settings.algorithm, "damping_credit", 1.0);
  if (one_step) set_parameter(settings.algorithm, "observer", 2.0);
  const Trial trial = attacked(settings);
  testing::forces_are_finite_and_within_the_limit(trial);
  testing::passivity_control_acts_or_is_capped(trial, cap, credit, one_step,
                                               wanted_by_energy_bounding(trial));
}

RC_GTEST_PROP(PassivityControlPromise, TakesWhatIsMissingUnlessCapped, ()) {
  follower_takes_what_is_missing(false);
}
RC_GTEST_PROP(PassivityControlPromise, WithCreditToleratesWhatTheDeviceEats, ()) {
  follower_takes_what_is_missing(true);
}
RC_GTEST_PROP(PassivityControlPromise, OneStepPaysForTheNextMoveIfItEqualsTheLast, ()) {
  follower_takes_what_is_missing(flip(), true);
}

// A force limit only takes force away: Eq. 6 stays above zero until the cap binds.
RC_GTEST_PROP(PassivityControlPromise, AForceLimitDoesNotBreakIt, ()) {
  constexpr double kCap = 1e6;
  ServoSettings settings = random_settings("energy-bounding");
  settings.force_limit_n = log_uniform(0.1, 20.0);
  set_parameter(settings.algorithm, "then", 1.0);
  set_parameter(settings.algorithm, "max_damping_n_s_per_m", kCap);
  const Trial trial = attacked(settings);
  const std::vector<double> wanted_n = wanted_by_energy_bounding(trial);
  bool capped = false;
  std::size_t k = 0;
  testing::for_each_step(trial, [&](const testing::Step& step) {
    capped = capped || (step.moved_m != 0.0 &&
                        std::abs(wanted_n[k]) > kCap * std::abs(step.now.velocity_m_per_s));
    ++k;
    if (!capped) RC_ASSERT(step.now.energy_cv_j >= -testing::kRounding * step.turnover_j);
  });
}

// At or below the floor the wall's force is not touched; above it every deficit of the held-force
// observer is answered.
RC_GTEST_PROP(PassivityControlPromise, ActsAboveItsVelocityFloorOnly, ()) {
  ServoSettings settings = random_settings("passivity-control");
  settings.force_limit_n = kNoLimit;
  const double floor = log_uniform(1e-3, 1.0);
  set_parameter(settings.algorithm, "observer", 1.0);
  set_parameter(settings.algorithm, "velocity_floor_m_per_s", floor);
  testing::passivity_control_acts_above(attacked(settings), floor);
}

// With reset, motion outside the wall has no effect: every contact gives the forces that it gives
// alone.
RC_GTEST_PROP(PassivityControlPromise, WithResetEveryContactIsTheFirst, ()) {
  ServoSettings settings = random_settings("passivity-control");
  set_parameter(settings.algorithm, "observer", *rc::gen::inRange(0, 3));
  set_parameter(settings.algorithm, "reset_in_free_motion", 1.0);
  const Trial trial = attacked(settings);
  testing::PositionBench alone(settings);
  for (std::size_t k = 0; k < trial.rows.size(); ++k) {
    // Begun anew one tick before a contact begins, so that its first displacement is known.
    const bool contact_next =
        k + 1 < trial.rows.size() && (trial.rows[k + 1].flags & kFlagInContact) != 0;
    const bool inside = (trial.rows[k].flags & kFlagInContact) != 0;
    if (!inside && contact_next) alone.reset();
    const Sample sample = alone.move_to(trial.rows[k].position_m);
    if (inside) RC_ASSERT(sample.force_n == trial.rows[k].force_n);
  }
}

// Any finite position, any parameters within their ranges, with and without a follower.
RC_GTEST_PROP(EveryAlgorithm, IsFiniteAndWithinTheLimitForAnyFiniteInput, ()) {
  ServoSettings settings = random_settings("none");
  settings.algorithm.index = *rc::gen::inRange<std::size_t>(0, algorithms().size());
  const auto parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (flip())
      settings.algorithm.values.at(i) = flip() ? parameters[i].minimum : parameters[i].maximum;
  }
  settings.force_limit_n = flip() ? 0.0 : log_uniform(1e-3, 1e6);
  testing::PositionBench bench(settings);
  Trial trial{settings, {}};
  for (int tick = 0; tick < 200; ++tick) {
    const double huge = log_uniform(1e-300, 1e300) * (flip() ? 1.0 : -1.0);
    const double near = 0.05 + testing::uniform(-1e-2, 1e-2);
    trial.rows.push_back(bench.move_to(*rc::gen::inRange(0, 10) == 0 ? huge : near));
  }
  testing::forces_are_finite_and_within_the_limit(trial);
}

// Within ±1 m no algorithm may give up: every force is finite.
RC_GTEST_PROP(EveryAlgorithm, NeverFailsWithinTheWorkspace, ()) {
  ServoSettings settings = random_settings("none");
  settings.algorithm.index = *rc::gen::inRange<std::size_t>(0, algorithms().size());
  if (flip()) set_parameter(settings.algorithm, "then", 1.0);
  if (flip()) set_parameter(settings.algorithm, "observer", 1.0);
  testing::PositionBench bench(settings);
  for (int tick = 0; tick < 500; ++tick) bench.move_to(testing::uniform(-1.0, 1.0));
  RC_ASSERT(!bench.servo().state().failed);
}

}  // namespace
}  // namespace hapticwall
