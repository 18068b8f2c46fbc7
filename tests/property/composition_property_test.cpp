// An algorithm followed by a passivity controller, `[algorithm] then = "passivity-control"`.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "core/run/batch_simulator.h"
#include "core/run/simulate.h"
#include "tests/batch_support.h"
#include "tests/position_bench.h"
#include "tests/property/scene_generator.h"
#include "tests/samples.h"

namespace hapticwall {
namespace {

using testing::any_algorithm;
using testing::flip;
using testing::log_uniform;
using testing::random_scene;
using testing::set_parameter;

void randomise_follower(AlgorithmSettings& settings) {
  if (flip()) set_parameter(settings, "observer", 1.0);
  if (flip()) set_parameter(settings, "damping_credit", 1.0);
  if (flip()) set_parameter(settings, "reset_in_free_motion", 1.0);
  if (flip()) set_parameter(settings, "max_damping_n_s_per_m", log_uniform(0.1, 1e4));
  if (flip()) set_parameter(settings, "velocity_floor_m_per_s", log_uniform(1e-4, 0.1));
}

std::vector<Sample> rows_of(const Scene& scene, std::span<const ScheduledChange> changes = {}) {
  RC_ASSERT(!validate(scene).has_value());
  return testing::samples_of(scene, changes);
}

void expect_same_motion(const std::vector<Sample>& a, const std::vector<Sample>& b) {
  RC_ASSERT(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    RC_ASSERT(a[k].force_n == b[k].force_n);
    RC_ASSERT(a[k].truth.position_m == b[k].truth.position_m);
  }
}

RC_GTEST_PROP(Composition, ThenNoneIsTheAlgorithmItself, ()) {
  Scene scene = random_scene(any_algorithm());
  randomise_follower(scene.algorithm);
  const auto alone = rows_of(scene);
  set_parameter(scene.algorithm, "then", 0.0);
  expect_same_motion(rows_of(scene), alone);
}

RC_GTEST_PROP(Composition, BehindNoneItIsPassivityControlToTheLastBit, ()) {
  Scene scene = random_scene("none");
  randomise_follower(scene.algorithm);
  set_parameter(scene.algorithm, "then", 1.0);
  Scene control = scene;
  control.algorithm.index = find_algorithm("passivity-control").value();
  set_parameter(control.algorithm, "then", 0.0);
  expect_same_motion(rows_of(scene), rows_of(control));
}

// The follower adds a damper of at most its cap.
RC_GTEST_PROP(Composition, WithACapOfNothingItIsTheAlgorithmItself, ()) {
  Scene scene = random_scene(any_algorithm());
  randomise_follower(scene.algorithm);
  // The cap is the controller's own, too: it is left out where it is the first algorithm.
  RC_PRE(algorithms()[scene.algorithm.index].name != "passivity-control");
  set_parameter(scene.algorithm, "max_damping_n_s_per_m", 0.0);
  const auto alone = rows_of(scene);
  set_parameter(scene.algorithm, "then", 1.0);
  expect_same_motion(rows_of(scene), alone);
}

// Without cap, floor, credit and limit no control law is active any more: Eq. 6 is never below
// zero, for any algorithm before and any motion of the handle.
RC_GTEST_PROP(Composition, MakesEveryControlLawPassive, ()) {
  Scene scene = random_scene(any_algorithm());
  ServoSettings settings = servo_settings(scene);
  settings.force_limit_n = std::numeric_limits<double>::max();
  set_parameter(settings.algorithm, "then", 1.0);
  set_parameter(settings.algorithm, "max_damping_n_s_per_m", 1e6);
  settings.encoder_m = 5e-4;  // no tiny move has to supply the missing energy
  double turnover_j = 0.0;
  double last_m = 0.0;
  const auto rows = testing::attack(settings, *rc::gen::arbitrary<std::uint64_t>(), 2000);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double moved_m = k == 0 ? 0.0 : rows[k].position_m - last_m;
    last_m = rows[k].position_m;
    turnover_j += std::abs(moved_m * rows[k].force_n);
    RC_ASSERT(rows[k].energy_cv_j >= -1e-12 * turnover_j);
  }
}

// Switched on or off while it runs: no jump of the force, and the observer begins anew.
RC_GTEST_PROP(Composition, IsSwitchedWhileItRunsWithoutAKick, ()) {
  Scene scene = random_scene(any_algorithm());
  randomise_follower(scene.algorithm);
  const bool on = flip();
  set_parameter(scene.algorithm, "then", on ? 0.0 : 1.0);
  ScheduledChange change{*rc::gen::inRange<std::uint64_t>(1, scene.tick_count() - 1), scene};
  set_parameter(change.scene.algorithm, "then", on ? 1.0 : 0.0);
  const auto plain = rows_of(scene);
  const auto changed = rows_of(scene, {&change, 1});
  RC_PRE(changed.size() > change.tick);
  for (std::size_t k = 0; k < change.tick; ++k) {
    RC_ASSERT(changed[k].force_n == plain[k].force_n);
  }
  RC_ASSERT(std::abs(changed[change.tick].force_n - changed[change.tick - 1].force_n) <= 1e-9);
}

RC_GTEST_PROP(Composition, IsTheSameInABatch, ()) {
  std::vector<Scene> scenes;
  for (int i = 0; i < 12; ++i) {
    scenes.push_back(random_scene(any_algorithm()));
    randomise_follower(scenes.back().algorithm);
    set_parameter(scenes.back().algorithm, "then", 1.0);
  }
  RC_ASSERT(testing::first_difference(simulate_batch(scenes), testing::one_by_one(scenes)) == "");
}

}  // namespace
}  // namespace hapticwall
