#include "core/identify/identify.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/identify/first_guess.h"
#include "core/identify/intervals.h"
#include "tests/core/identify/trial_device.h"

namespace hapticwall::identify {
namespace {

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

TEST(Identify, NoiseAtRestIsNoMisfit) {
  TrialDevice device;
  device.noise_m = device.encoder_m;
  const TrialRun run = run_trial(device, 12.0);
  const auto found = identify(run.record, run.facts);
  ASSERT_TRUE(found && found->fits);
  EXPECT_NEAR(found->noise_m, device.noise_m, 0.2 * device.noise_m);
  EXPECT_NEAR(found->mass_kg.value, device.mass_kg, 0.01 * device.mass_kg);
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

TEST(Identify, TheFirstGuessIsNear) {
  const TrialDevice device;
  const TrialRun run = run_trial(device, 8.0);
  const auto guesses = first_guesses(run.record, run.facts.first_stroke_tick, 12.0);
  ASSERT_FALSE(guesses.empty());
  EXPECT_NEAR(std::exp(guesses.front().parameters[kLogMass]), device.mass_kg, 0.03);
  EXPECT_NEAR(guesses.front().delay_s, 1.5e-3, 1e-3);
}

// From tables.
TEST(Identify, TheQuantilesAreStudents) {
  EXPECT_NEAR(student_quantile(5), 2.5706, 3e-3);
  EXPECT_NEAR(student_quantile(26), 2.0555, 1e-4);
}

}  // namespace
}  // namespace hapticwall::identify
