#include "core/study/identify/identify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/study/identify/first_guess.h"
#include "core/study/identify/intervals.h"
#include "tests/core/study/identify/trial_device.h"

namespace hapticwall::identify {
namespace {

using ::testing::ElementsAre;
using ::testing::IsSupersetOf;
using testing::random_device;
using testing::run_trial;
using testing::TrialDevice;
using testing::TrialRun;

bool covers(const Estimate& estimate, double truth) {
  return estimate.low <= truth && truth <= estimate.high;
}

// The whole proof is a program, hapticwall_identify_proof.
TEST(Identify, FindsRandomDevicesOfAnotherSimulator) {
  int covered = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const TrialDevice device = random_device(seed);
    const TrialRun run = run_trial(device, 12.0);
    ASSERT_EQ(run.facts.state, ExperimentState::kDone) << seed;
    const auto found = identify(run.record, run.facts);
    ASSERT_TRUE(found && found->fits) << seed;
    EXPECT_NEAR(found->mass_kg.value / device.mass_kg, 1.0, 0.01) << seed;
    EXPECT_NEAR(found->damping_n_s_per_m.value / device.damping_n_s_per_m, 1.0, 0.02) << seed;
    EXPECT_NEAR(found->friction_n.value, device.friction_n, 1e-3) << seed;
    EXPECT_EQ(found->delay_ticks, device.delay_ticks) << seed;
    covered += covers(found->mass_kg, device.mass_kg) ? 1 : 0;
    covered += covers(found->damping_n_s_per_m, device.damping_n_s_per_m) ? 1 : 0;
    covered += covers(found->friction_n, device.friction_n) ? 1 : 0;
    covered +=
        covers(found->delay_s, static_cast<double>(device.delay_ticks) * 1e-3 + device.lag_s);
  }
  EXPECT_GE(covered, 13) << "of 16 intervals of 95 %";
}

TEST(Identify, FindsTheFrictionOfBothDirections) {
  TrialDevice device;
  device.friction_difference_n = 0.04;
  const TrialRun run = run_trial(device, 12.0);
  const auto found = identify(run.record, run.facts);
  ASSERT_TRUE(found && found->fits);
  EXPECT_NEAR(found->friction_up_n.value, 0.12, 1e-3);
  EXPECT_NEAR(found->friction_down_n.value, 0.08, 1e-3);
  EXPECT_NEAR(found->friction_n.value, 0.1, 1e-3);
}

// One segment of this record begins far from its best start.
TEST(Identify, ASegmentThatFitsBadlyIsFoundAgain) {
  const TrialRun run = run_trial(random_device(140));
  const auto found = identify(run.record, run.facts);
  ASSERT_TRUE(found && found->fits);
  EXPECT_LT(found->residual_ratio, 1.0);
}

TEST(Identify, TellsTheDelaysThatTheRecordDoesNotExclude) {
  const TrialRun clear = run_trial(TrialDevice{}, 12.0);
  const auto one = identify(clear.record, clear.facts);
  ASSERT_TRUE(one && one->fits);
  EXPECT_THAT(one->possible_delays, ElementsAre(1U));

  const TrialDevice coarse = random_device(21);  // 4 ticks, 246 µm
  const TrialRun run = run_trial(coarse);
  const auto two = identify(run.record, run.facts);
  ASSERT_TRUE(two && two->fits);
  EXPECT_THAT(two->possible_delays, IsSupersetOf({3U, 4U}));
  EXPECT_TRUE(covers(two->delay_s, 4e-3 + coarse.lag_s));
  const double width_s = two->lag_s.high - two->lag_s.low;
  EXPECT_GT(two->delay_s.high - two->delay_s.low, 1.05 * width_s) << "it spans them all";
}

TEST(Identify, SaysThatTheModelDoesNotFit) {
  TrialDevice backlash;
  backlash.backlash_m = 0.2e-3;
  TrialDevice cogging;
  cogging.cogging_n = 0.1;
  for (const TrialDevice& device : {backlash, cogging}) {
    const TrialRun run = run_trial(device, 8.0);
    ASSERT_EQ(run.facts.state, ExperimentState::kDone);
    const auto found = identify(run.record, run.facts);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->fits);
    EXPECT_GT(found->residual_ratio, kMaxResidualRatio);
  }
}

TEST(Identify, NoiseAtRestIsNoMisfitAndWidensTheIntervals) {
  TrialDevice device;
  device.noise_m = 4.0 * device.encoder_m;
  const TrialRun run = run_trial(device, 12.0);
  const auto found = identify(run.record, run.facts);
  ASSERT_TRUE(found && found->fits);
  EXPECT_NEAR(found->noise_m, device.noise_m, 0.2 * device.noise_m);
  EXPECT_NEAR(found->mass_kg.value, device.mass_kg, 0.01 * device.mass_kg);
  EXPECT_TRUE(covers(found->mass_kg, device.mass_kg));
  EXPECT_TRUE(covers(found->damping_n_s_per_m, device.damping_n_s_per_m));
  EXPECT_TRUE(covers(found->friction_n, device.friction_n));
}

TEST(Identify, ADeviceWithoutFrictionLagAndDelayIsAtTheBounds) {
  TrialDevice device;
  device.friction_n = 0.0;
  device.lag_s = 0.0;
  device.delay_ticks = 0;
  const TrialRun run = run_trial(device, 12.0);
  const auto found = identify(run.record, run.facts);
  ASSERT_TRUE(found && found->fits);
  EXPECT_GE(found->friction_up_n.value, 0.0);
  EXPECT_GE(found->friction_down_n.value, 0.0);
  EXPECT_LT(found->friction_n.value, 1e-3);
  EXPECT_GE(found->lag_s.value, 0.0);
  EXPECT_LT(found->delay_s.value, 50e-6);
}

// Its handle rests between two of them.
TEST(Identify, TwoCountsAtRestAreNoNoise) {
  const TrialDevice device;
  TrialRun run = run_trial(device, 8.0);
  run.facts.rest_range_m = device.encoder_m;
  run.facts.rest_variance_m2 = device.encoder_m * device.encoder_m / 4.0;
  const auto found = identify(run.record, run.facts);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->noise_m, 0.0);
}

TEST(Identify, AShortRecordHasNoResult) {
  const TrialRun run = run_trial(TrialDevice{}, 4.0);
  EXPECT_FALSE(identify(run.record, run.facts));
}

TEST(Identify, ARecordWithoutStrokesHasNoResult) {
  Record record;
  record.encoder_m = 30e-6;
  record.position_m.assign(20000, 0.03);
  record.force_n.assign(20000, 0.0);
  ExperimentFacts facts;
  facts.first_stroke_tick = 1000;
  EXPECT_FALSE(identify(record, facts));
}

TEST(Identify, TheResolutionIsTheSmallestStep) {
  EXPECT_NEAR(smallest_step({0.0, 0.0, 0.002, 0.003, 0.003, 0.001}), 0.001, 1e-12);
  EXPECT_EQ(smallest_step({0.1, 0.1}), 0.0);
}

TEST(Identify, ALateReportIsLateInTheRecord) {
  const std::vector<double> force_n{0.0, 0.0, 1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0,
                                    0.5, 0.5, 0.5, 0.5, 0.5, 0.5, -0.5, -0.5, -0.5, -0.5};
  std::vector<double> applied_n{0.0, 0.0};  // two ticks later
  applied_n.insert(applied_n.end(), force_n.begin(), force_n.end() - 2);
  EXPECT_EQ(taken_forces(force_n, applied_n), force_n);
  applied_n[8] = 1.0;  // one is late by a tick
  std::vector<double> late_n = force_n;
  late_n[6] = 1.0;
  EXPECT_EQ(taken_forces(force_n, applied_n), late_n);
  EXPECT_EQ(taken_forces(force_n, std::vector<double>(20, 0.0)), force_n) << "it tells nothing";
  EXPECT_EQ(taken_forces({}, {}), std::vector<double>{});
}

// A wheel's reports wait for each other: every tenth change of the force comes a tick late.
TEST(Identify, FitsADeviceThatTellsWhichForcesWereLate) {
  TrialDevice device;
  device.encoder_m = 31e-6;
  device.late_change = 0.1;
  TrialRun run = run_trial(device, 12.0);
  const auto blind = identify(run.record, run.facts);
  ASSERT_TRUE(blind);
  EXPECT_FALSE(blind->fits) << blind->residual_ratio;
  run.record.force_n = taken_forces(run.record.force_n, run.applied_n);
  const auto found = identify(run.record, run.facts);
  ASSERT_TRUE(found && found->fits) << found->residual_ratio;
  EXPECT_NEAR(found->mass_kg.value, device.mass_kg, 1e-3 * device.mass_kg);
  EXPECT_NEAR(found->damping_n_s_per_m.value, device.damping_n_s_per_m, 1e-2);
}

TEST(Identify, TheFirstGuessIsNear) {
  const TrialDevice device;
  const TrialRun run = run_trial(device, 8.0);
  const auto guesses = first_guesses(run.record, run.facts.first_stroke_tick, 12.0);
  ASSERT_FALSE(guesses.empty());
  EXPECT_NEAR(std::exp(guesses.front().parameters[kLogMass]), device.mass_kg, 0.03);
  EXPECT_NEAR(guesses.front().delay_s, 1.5e-3, 1e-3);
}

// The values are from tables.
TEST(Identify, TheQuantilesAreStudents) {
  EXPECT_NEAR(student_quantile(5), 2.5706, 3e-3);
  EXPECT_NEAR(student_quantile(26), 2.0555, 1e-4);
}

}  // namespace
}  // namespace hapticwall::identify
