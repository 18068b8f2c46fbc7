// The study of speed against accuracy: what it measures, on scenes whose answers are known, and how
// it measures time, with a clock of its own.
#include "core/study/accuracy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"

namespace hapticwall {
namespace {

constexpr std::int64_t kStepNs = 3'000'000;  // clock step; longer than a row is timed in a round

// The golden-hard scene: a stiff wall chatters by 0.9903 mm.
Scene chatter() {
  Scene scene;
  scene.name = "chatter";
  scene.duration_s = 5.0;
  scene.x().device.mass_kg = 0.1;
  scene.x().device.force_limit_n = 8.9;
  HandSettings hand;
  hand.mass_kg = 0.1;
  hand.stiffness_n_per_m = 300.0;
  hand.damping_n_s_per_m = 5.0;
  hand.path = {{0.0, 0.03}, {0.3, 0.06}};
  scene.x().hand = hand;
  scene.x().walls = {{.position_m = 0.05, .stiffness_n_per_m = 35'000.0, .damping_n_s_per_m = 0.0}};
  scene.algorithm.index = *find_algorithm("none");
  return scene;
}

Scene short_chatter() {
  Scene scene = chatter();
  scene.duration_s = 0.2;
  return scene;
}

// Every look at the clock is a step later.
AccuracyOptions stepping(std::vector<int> substeps) {
  AccuracyOptions options;
  options.substeps = std::move(substeps);
  options.now_ns = [now = std::int64_t{0}]() mutable { return now += kStepNs; };
  return options;
}

const AccuracyRow& row_of(const AccuracyStudy& study, Integrator integrator, int substeps) {
  const auto found = std::find_if(study.rows.begin(), study.rows.end(), [&](const auto& row) {
    return row.integrator == integrator && row.substeps.value_or(1) == substeps;
  });
  if (found == study.rows.end()) throw std::out_of_range("no such row");
  return *found;
}

TEST(Accuracy, HasARowForExactAndForEveryIntegratorAndSubstepCount) {
  const AccuracyStudy study = measure_accuracy(short_chatter(), stepping({1, 4}));
  ASSERT_EQ(study.rows.size(), 5U);
  EXPECT_FALSE(study.stopped_early);
  EXPECT_EQ(study.rows[0].integrator, Integrator::kExact);
  EXPECT_FALSE(study.rows[0].substeps.has_value());
  EXPECT_EQ(study.rows[1].integrator, Integrator::kSemiImplicitEuler);
  EXPECT_EQ(study.rows[1].substeps, 1);
  EXPECT_EQ(study.rows[2].substeps, 4);
  EXPECT_EQ(study.rows[3].integrator, Integrator::kRungeKutta4);
  EXPECT_EQ(study.rows[4].substeps, 4);
}

// Every engine with a symplectic step of 1 ms shows a quiet wall.
TEST(Accuracy, TheLimitCycleVanishesUnderOneSymplecticStepATick) {
  const AccuracyStudy study = measure_accuracy(chatter(), stepping({1, 100}));
  EXPECT_EQ(study.reference.verdict, Verdict::kOscillating);
  EXPECT_NEAR(*study.reference.tail_peak_to_peak_m, 0.9903e-3, 1e-7);

  const AccuracyRow& euler = row_of(study, Integrator::kSemiImplicitEuler, 1);
  EXPECT_EQ(euler.verdict, Verdict::kSettled);
  EXPECT_FALSE(euler.verdict_agrees);
  EXPECT_LT(*euler.tail_peak_to_peak_m, 1e-6);
  EXPECT_NEAR(*euler.tail_peak_to_peak_relative_error, -1.0, 1e-3);
  EXPECT_GT(*euler.max_position_error_m, 5e-4);

  const AccuracyRow& exact = row_of(study, Integrator::kExact, 1);
  EXPECT_TRUE(exact.verdict_agrees);
  EXPECT_LT(*exact.max_position_error_m, 1e-14);
  EXPECT_LT(std::abs(*exact.energy_balance_error_j), 1e-12);
  EXPECT_LT(std::abs(*exact.tail_peak_to_peak_relative_error), 1e-10);

  const AccuracyRow& fine_euler = row_of(study, Integrator::kSemiImplicitEuler, 100);
  EXPECT_TRUE(fine_euler.verdict_agrees);
  EXPECT_LT(std::abs(*fine_euler.tail_peak_to_peak_relative_error), 0.01);
  const AccuracyRow& fine_rk4 = row_of(study, Integrator::kRungeKutta4, 100);
  EXPECT_LT(*fine_rk4.max_position_error_m, 1e-12);
  EXPECT_LT(*fine_rk4.max_position_error_m, *fine_euler.max_position_error_m);
}

// The largest error is that of two runs side by side, the end of the last hold included.
TEST(Accuracy, ThePositionErrorIsTheLargestOverAllTicks) {
  const Scene scene = short_chatter();
  const auto positions = [](const Scene& of) {
    std::vector<double> all;
    SimulationOptions options;
    options.on_sample = [&](const Sample& sample) { all.push_back(sample.truth.position_m); };
    all.push_back(simulate(of, options).final_state.truth.position_m);
    return all;
  };
  Scene euler = scene;
  euler.simulator = {Integrator::kSemiImplicitEuler, 3};
  const std::vector<double> right = positions(scene);
  const std::vector<double> wrong = positions(euler);
  double largest_m = 0.0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    largest_m = std::max(largest_m, std::abs(right[i] - wrong[i]));
  }
  const AccuracyStudy study = measure_accuracy(scene, stepping({3}));
  const AccuracyRow& row = row_of(study, Integrator::kSemiImplicitEuler, 3);
  EXPECT_NEAR(*row.max_position_error_m, largest_m, 1e-14);
  EXPECT_NEAR(*row.energy_balance_error_j, *simulate(euler).summary.energy_balance_error_j, 1e-15);
}

// After a single tick only the state at its end can differ.
TEST(Accuracy, TheEndOfTheLastHoldCounts) {
  Scene scene = short_chatter();
  scene.x().walls.clear();
  scene.duration_s = 0.001;
  scene.x().hand->path = {{0.0, 0.03}, {0.3, 0.33}};
  const AccuracyStudy study = measure_accuracy(scene, stepping({1}));
  EXPECT_GT(*row_of(study, Integrator::kSemiImplicitEuler, 1).max_position_error_m, 0.0);
}

TEST(Accuracy, TheScenesOwnIntegratorDoesNotMatter) {
  Scene scene = short_chatter();
  const AccuracyStudy one = measure_accuracy(scene, stepping({1, 2}));
  scene.simulator = {Integrator::kSemiImplicitEuler, 7};
  const AccuracyStudy other = measure_accuracy(scene, stepping({1, 2}));
  ASSERT_EQ(one.rows.size(), other.rows.size());
  EXPECT_EQ(one.reference.tail_peak_to_peak_m, other.reference.tail_peak_to_peak_m);
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    EXPECT_EQ(one.rows[i].max_position_error_m, other.rows[i].max_position_error_m);
    EXPECT_EQ(one.rows[i].energy_balance_error_j, other.rows[i].energy_balance_error_j);
  }
}

// A grip far too stiff for a step of 1 ms: the stepped integrators leave, the exact one does not.
TEST(Accuracy, ARunThatDivergedHasATickAndNoErrors) {
  Scene scene = short_chatter();
  scene.x().hand->mass_kg = 0.4;
  scene.x().hand->grip_stiffness_n_per_m = 1e7;
  scene.x().hand->grip_damping_n_s_per_m = 1.0;
  const AccuracyStudy study = measure_accuracy(scene, stepping({1}));
  EXPECT_NE(study.reference.verdict, Verdict::kDiverged);
  EXPECT_TRUE(study.rows[0].max_position_error_m.has_value());
  for (const Integrator integrator : {Integrator::kSemiImplicitEuler, Integrator::kRungeKutta4}) {
    const AccuracyRow& row = row_of(study, integrator, 1);
    EXPECT_EQ(row.verdict, Verdict::kDiverged);
    EXPECT_FALSE(row.verdict_agrees);
    EXPECT_TRUE(row.diverged_at_tick.has_value());
    EXPECT_FALSE(row.max_position_error_m.has_value());
    EXPECT_FALSE(row.energy_balance_error_j.has_value());
    EXPECT_FALSE(row.tail_peak_to_peak_m.has_value());
    EXPECT_FALSE(row.tail_peak_to_peak_relative_error.has_value());
    EXPECT_TRUE(row.ns_per_tick.has_value());
  }
}

// Without damping and force limit the hold feeds the oscillation until it diverges, except with the
// one integrator that does not see this.
TEST(Accuracy, NothingIsOffFromAReferenceThatDiverged) {
  Scene scene = chatter();
  scene.x().device.damping_n_s_per_m = 0.0;
  scene.x().device.force_limit_n.reset();
  scene.x().hand->damping_n_s_per_m = 0.0;
  const AccuracyStudy study = measure_accuracy(scene, stepping({1}));
  ASSERT_EQ(study.reference.verdict, Verdict::kDiverged);
  const AccuracyRow& exact = row_of(study, Integrator::kExact, 1);
  EXPECT_TRUE(exact.verdict_agrees);
  EXPECT_EQ(exact.diverged_at_tick, study.reference.diverged_at_tick);
  const AccuracyRow& euler = row_of(study, Integrator::kSemiImplicitEuler, 1);
  ASSERT_NE(euler.verdict, Verdict::kDiverged);
  EXPECT_FALSE(euler.verdict_agrees);
  EXPECT_TRUE(euler.tail_peak_to_peak_m.has_value());
  for (const AccuracyRow& row : study.rows) {
    EXPECT_FALSE(row.max_position_error_m.has_value());
    EXPECT_FALSE(row.tail_peak_to_peak_relative_error.has_value());
  }
}

TEST(Accuracy, AReferenceAtRestHasNoAmplitudeToBeOffFrom) {
  Scene scene = short_chatter();
  scene.x().hand.reset();
  const AccuracyStudy study = measure_accuracy(scene, stepping({1}));
  EXPECT_EQ(study.reference.verdict, Verdict::kNoContact);
  for (const AccuracyRow& row : study.rows) {
    EXPECT_TRUE(row.verdict_agrees);
    EXPECT_EQ(row.max_position_error_m, 0.0);
    EXPECT_EQ(row.tail_peak_to_peak_m, 0.0);
    EXPECT_FALSE(row.tail_peak_to_peak_relative_error.has_value());
  }
}

// The clock is looked at before the set-up, after it, and at the end: each lasts one step.
TEST(Accuracy, TimesAreOfTheLoopWithoutTheSetUp) {
  const AccuracyStudy study = measure_accuracy(short_chatter(), stepping({1, 2}));
  for (const AccuracyRow& row : study.rows) {
    EXPECT_EQ(row.set_up_ns, kStepNs);
    EXPECT_EQ(row.ns_per_tick, static_cast<double>(kStepNs) / 200.0);
    EXPECT_EQ(row.ratio_to_exact, 1.0);
  }
}

// A clock that runs ten times as fast while the looks at it are in [from, to).
AccuracyOptions disturbed(int from, int to) {
  AccuracyOptions options = stepping({1, 2});
  options.now_ns = [now = std::int64_t{0}, looks = 0, from, to]() mutable {
    const bool disturbance = looks >= from && looks < to;
    ++looks;
    return now += disturbance ? 10 * kStepNs : kStepNs;
  };
  return options;
}

// Seven rounds of five rows with three looks at the clock each. A disturbance of three rounds on
// end hits every row three times, and no median; it would spoil whole rows that were measured one
// after the other.
TEST(Accuracy, ADisturbanceOfSomeRoundsIsInNoMedian) {
  constexpr int kLooksPerRound = 5 * 3;
  const AccuracyStudy calm = measure_accuracy(short_chatter(), stepping({1, 2}));
  const AccuracyStudy some =
      measure_accuracy(short_chatter(), disturbed(2 * kLooksPerRound, 5 * kLooksPerRound));
  const AccuracyStudy most = measure_accuracy(short_chatter(), disturbed(0, 4 * kLooksPerRound));
  for (std::size_t i = 0; i < calm.rows.size(); ++i) {
    EXPECT_EQ(some.rows[i].ns_per_tick, calm.rows[i].ns_per_tick) << i;
    EXPECT_EQ(most.rows[i].ns_per_tick, 10.0 * *calm.rows[i].ns_per_tick) << i;
    EXPECT_EQ(most.rows[i].ratio_to_exact, 1.0) << i;
  }
}

TEST(Accuracy, AClockThatStandsStillIsNoEndlessLoop) {
  AccuracyOptions options = stepping({1});
  options.now_ns = [] { return std::int64_t{0}; };
  Scene scene = short_chatter();
  scene.duration_s = 0.01;
  const AccuracyStudy study = measure_accuracy(scene, options);
  EXPECT_EQ(study.rows[1].ns_per_tick, 0.0);
  EXPECT_FALSE(study.rows[1].ratio_to_exact.has_value());
}

TEST(Accuracy, EndsWhenAskedTo) {
  for (const int allowed : {0, 3, 20}) {
    AccuracyOptions options = stepping({1, 2});
    int asked = 0;
    options.should_stop = [&] { return asked++ >= allowed; };
    EXPECT_TRUE(measure_accuracy(short_chatter(), options).stopped_early) << allowed;
    // The stopped run asks once more at most; nothing is begun after it.
    EXPECT_LE(asked, allowed + 1);
  }
}

TEST(Accuracy, TellsHowFarItHasCome) {
  AccuracyOptions options = stepping({1, 2});
  std::vector<double> told;
  options.on_progress = [&](double done) { told.push_back(done); };
  static_cast<void>(measure_accuracy(chatter(), options));
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.front(), 0.0);
  EXPECT_GT(told.back(), 0.9);
  EXPECT_LE(told.back(), 1.0);
}

TEST(Accuracy, RefusesWhatItCannotMeasure) {
  const auto refuses = [](const Scene& scene, const AccuracyOptions& options) {
    EXPECT_THROW(static_cast<void>(measure_accuracy(scene, options)), std::invalid_argument);
  };
  refuses(short_chatter(), stepping({0}));
  refuses(short_chatter(), stepping({1, kMaxSubsteps + 1}));
  AccuracyOptions clockless = stepping({1});
  clockless.now_ns = nullptr;
  refuses(short_chatter(), clockless);
  Scene long_scene = short_chatter();
  long_scene.duration_s = 1e-3 * static_cast<double>(kMaxAccuracyTicks + 1);
  refuses(long_scene, stepping({1}));
  Scene led = short_chatter();
  led.x().hand->follows_mouse = true;
  led.x().hand->path = {};
  refuses(led, stepping({1}));
}

}  // namespace
}  // namespace hapticwall
