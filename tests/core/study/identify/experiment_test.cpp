#include "core/study/identify/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/core/study/identify/trial_device.h"

namespace hapticwall::identify {
namespace {

using testing::TrialDevice;
using testing::TrialSimulator;

struct Ended {
  ExperimentFacts facts;
  double peak_force_n = 0.0;
  double peak_m = 0.0;
  std::uint64_t lie_ticks = 0;  // from the first lie to the end
};

// `lie` gets the tick and the true position, and returns what the device reports.
Ended run_until_end(const TrialDevice& device,
                    const std::function<double(std::uint64_t, double)>& lie,
                    double force_factor = 1.0) {
  ExperimentSettings settings;
  settings.encoder_m = device.encoder_m;
  settings.duration_s = 10.0;
  Experiment experiment(settings);
  TrialSimulator simulator(device);
  Ended ended;
  for (std::uint64_t tick = 0; tick < 60000; ++tick) {
    const double truth_m = simulator.position_m();
    const double told_m = lie(tick, truth_m);
    ended.lie_ticks += ended.lie_ticks > 0 || told_m != truth_m ? 1 : 0;
    const double force_n = experiment.step(told_m);
    if (experiment.facts().state != ExperimentState::kRunning) {
      EXPECT_EQ(force_n, 0.0);
      break;
    }
    EXPECT_EQ(force_n, 1e-3 * std::round(force_n / 1e-3)) << "a device would round it";
    ended.peak_force_n = std::max(ended.peak_force_n, std::abs(force_n));
    ended.peak_m = std::max(ended.peak_m, std::abs(truth_m - 0.03));
    simulator.advance(force_factor * force_n);
  }
  ended.facts = experiment.facts();
  EXPECT_EQ(experiment.step(0.03), 0.0) << "the force stays off";
  EXPECT_EQ(experiment.facts().ticks, ended.facts.ticks);
  return ended;
}

double honest(std::uint64_t /*tick*/, double truth_m) { return truth_m; }

TEST(Experiment, EndsAfterItsStrokesWithinTravelAndLimit) {
  const Ended ended = run_until_end(TrialDevice{}, honest);
  EXPECT_EQ(ended.facts.state, ExperimentState::kDone);
  EXPECT_GT(ended.facts.turns, 30U);
  EXPECT_LE(ended.peak_force_n, 0.4) << "as much as it needs: 0.2 of the limit";
  EXPECT_LT(ended.peak_m, 0.035);
  EXPECT_GT(ended.peak_m, 0.012);
  EXPECT_NEAR(ended.facts.break_away_n[0], 0.1, 0.05);
  EXPECT_NEAR(ended.facts.break_away_n[1], 0.1, 0.05);
}

TEST(Experiment, TheSameSeedGivesTheSameForces) {
  const auto once = testing::run_trial(TrialDevice{}, 3.0);
  const auto again = testing::run_trial(TrialDevice{}, 3.0);
  EXPECT_EQ(once.record.force_n, again.record.force_n);
}

TEST(Experiment, WaitsForAHandleAtRest) {
  const Ended ended = run_until_end(TrialDevice{}, [](std::uint64_t tick, double truth_m) {
    return truth_m + 5e-6 * static_cast<double>(tick);
  });
  EXPECT_EQ(ended.facts.state, ExperimentState::kNotAtRest);
  EXPECT_EQ(ended.peak_force_n, 0.0);
}

TEST(Experiment, NoiseIsNoMotion) {
  const Ended ended = run_until_end(TrialDevice{}, [](std::uint64_t tick, double truth_m) {
    return truth_m + (tick % 2 == 0 ? 0.45e-3 : 0.0);
  });
  EXPECT_GT(ended.facts.break_away_n[0], 0.08);
  EXPECT_GT(ended.facts.break_away_n[1], 0.08);
}

TEST(Experiment, AWrongSignEndsItAtASmallForce) {
  const Ended ended = run_until_end(TrialDevice{}, honest, -1.0);
  EXPECT_EQ(ended.facts.state, ExperimentState::kWrongSign);
  EXPECT_LT(ended.peak_force_n, 0.2);
  EXPECT_LT(ended.peak_m, 2e-3);
}

TEST(Experiment, FrictionBeyondTheForceEndsIt) {
  TrialDevice device;
  device.friction_n = 2.5;
  const Ended ended = run_until_end(device, honest);
  EXPECT_EQ(ended.facts.state, ExperimentState::kNoMotion);
}

// The strokes push with 90 % of the limit at most.
TEST(Experiment, FrictionThatLeavesNoForceForStrokesEndsItBeforeThem) {
  TrialDevice device;
  device.mass_kg = 0.02;
  device.friction_n = 1.75;
  const Ended ended = run_until_end(device, honest);
  EXPECT_EQ(ended.facts.state, ExperimentState::kNoMotion);
  EXPECT_EQ(ended.facts.first_stroke_tick, 0U);
}

// The handle runs away from the second ramp on, against the force of the ramp.
TEST(Experiment, AHandleThatRunsAwayInARampEndsIt) {
  const Ended ended = run_until_end(TrialDevice{}, [](std::uint64_t tick, double truth_m) {
    return tick < 1400 ? truth_m : truth_m + 0.2e-3 * static_cast<double>(tick - 1400);
  });
  EXPECT_EQ(ended.facts.state, ExperimentState::kTooFar);
  EXPECT_EQ(ended.facts.first_stroke_tick, 0U);
}

// The jump comes at rest, and in a stroke.
TEST(Experiment, AJumpEndsItInTheSameTick) {
  for (const std::uint64_t first : {100U, 5000U}) {
    for (const double jump_m : {0.01, -0.01, std::nan("")}) {
      const Ended ended = run_until_end(TrialDevice{}, [&](std::uint64_t tick, double truth_m) {
        return tick >= first ? truth_m + jump_m : truth_m;
      });
      EXPECT_EQ(ended.facts.state, ExperimentState::kJumped);
      EXPECT_EQ(ended.lie_ticks, 1U);
    }
  }
}

TEST(Experiment, AFrozenPositionEndsItSoon) {
  double held_m = 0.0;
  const Ended ended = run_until_end(TrialDevice{}, [&](std::uint64_t tick, double truth_m) {
    if (tick < 5000) held_m = truth_m;
    return held_m;
  });
  EXPECT_EQ(ended.facts.state, ExperimentState::kFrozen);
  EXPECT_LT(ended.lie_ticks, 800U);
}

TEST(Experiment, ASignThatTurnsOverEndsItBeforeTheHandleGoesFar) {
  ExperimentSettings settings;
  settings.encoder_m = 30e-6;
  Experiment experiment(settings);
  TrialSimulator simulator{TrialDevice{}};
  double farthest_m = 0.0;
  for (int tick = 0; experiment.facts().state == ExperimentState::kRunning; ++tick) {
    ASSERT_LT(tick, 8000);
    const double position_m = simulator.position_m();
    farthest_m = std::max(farthest_m, std::abs(position_m - 0.03));
    simulator.advance((tick < 5000 ? 1.0 : -1.0) * experiment.step(position_m));
  }
  EXPECT_EQ(experiment.facts().state, ExperimentState::kTooFar);
  EXPECT_LT(farthest_m, 0.06);
}

TEST(Experiment, ALostForceEndsIt) {
  ExperimentSettings settings;
  settings.encoder_m = 30e-6;
  Experiment experiment(settings);
  TrialSimulator simulator{TrialDevice{}};
  for (int tick = 0; experiment.facts().state == ExperimentState::kRunning; ++tick) {
    ASSERT_LT(tick, 8000);
    simulator.advance((tick < 5000 ? 1.0 : 0.0) * experiment.step(simulator.position_m()));
  }
  EXPECT_EQ(experiment.facts().state, ExperimentState::kFrozen);
}

TEST(Experiment, AHandleThatIsTooSlowEndsIt) {
  TrialDevice device;
  device.damping_n_s_per_m = 300.0;
  EXPECT_EQ(run_until_end(device, honest).facts.state, ExperimentState::kTravelNotReached);
}

// Facts for a handle that moves at 0.1 m/s, and turns round only beyond `reach_m`.
ExperimentFacts facts_of_reach(double reach_m) {
  ExperimentSettings settings;
  settings.encoder_m = 30e-6;
  Experiment experiment(settings);
  double from_start_m = 0.0;
  double step_m = 0.0;
  while (experiment.facts().state == ExperimentState::kRunning) {
    const double force_n = experiment.step(0.03 + from_start_m);
    const bool turns = step_m == 0.0 || std::abs(from_start_m) >= reach_m;
    if (turns && force_n != 0.0) step_m = force_n > 0.0 ? -1e-4 : 1e-4;
    from_start_m += step_m;
  }
  return experiment.facts();
}

TEST(Experiment, StrokesThatMissTheTravelEndIt) {
  EXPECT_EQ(facts_of_reach(0.018).state, ExperimentState::kDone);
  const ExperimentFacts facts = facts_of_reach(0.03);
  EXPECT_EQ(facts.state, ExperimentState::kTravelNotReached);
  EXPECT_EQ(facts.turns, 9U);
}

TEST(Experiment, AHandleThatTheGuardTurnsTooOftenEndsIt) {
  const ExperimentFacts facts = facts_of_reach(0.04);
  EXPECT_EQ(facts.state, ExperimentState::kTooFar);
  EXPECT_EQ(facts.turns, 0U) << "the guard ends a stroke";
}

TEST(Experiment, AHandThatHoldsEndsIt) {
  TrialDevice device;
  device.hand_stiffness_n_per_m = 300.0;
  device.hand_damping_n_s_per_m = 3.0;
  const Ended ended = run_until_end(device, honest);
  EXPECT_NE(ended.facts.state, ExperimentState::kDone);
  EXPECT_FALSE(experiment_trouble(ended.facts.state).empty());
}

}  // namespace
}  // namespace hapticwall::identify
