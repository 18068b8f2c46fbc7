#include "core/run/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/algorithm/algorithm.h"

namespace hapticwall {
namespace {

Sample at(std::uint64_t tick, double position_m, double force_n, double wall_m = 0.05) {
  Sample sample;
  sample.tick = tick;
  sample.position_m = position_m;
  sample.truth.position_m = position_m;
  sample.penetration_m = position_m - wall_m;
  sample.force_n = force_n;
  if (sample.penetration_m > 0.0) sample.flags |= kFlagInContact;
  if (force_n == 8.9) sample.flags |= kFlagForceLimit;
  return sample;
}

Scene wall_at_ten_hertz() {
  Scene scene;
  scene.name = "hand-made";
  scene.sampling.rate_hz = 10.0;
  scene.x().walls = {{0.05, 1e3, 0.0}};
  return scene;
}

// Twenty ticks at 10 Hz: the tail is the last ten.
TEST(Metrics, JudgesTheLastSecond) {
  Metrics metrics(wall_at_ten_hertz(), 20, true);
  for (std::uint64_t k = 0; k < 10; ++k) metrics.add(at(k, 0.0, 0.0));
  for (std::uint64_t k = 10; k < 20; ++k)
    metrics.add(at(k, k % 2 == 0 ? 0.051 : 0.052, k % 2 == 0 ? 1.0 : 3.0));
  const Summary summary = metrics.finish();
  EXPECT_EQ(summary.verdict, Verdict::kOscillating);
  EXPECT_NEAR(summary.tail_peak_to_peak_m.value(), 1e-3, 1e-15);
  EXPECT_NEAR(summary.tail_force_mean_n.value(), 2.0, 1e-12);
  EXPECT_NEAR(summary.tail_force_std_n.value(), 1.0, 1e-12);
  EXPECT_NEAR(summary.displayed_stiffness_n_per_m.value(), 2.0 / 1.5e-3, 1e-6);
  EXPECT_NEAR(summary.max_penetration_m.value(), 2e-3, 1e-15);
  EXPECT_EQ(summary.peak_force_n, 3.0);
  EXPECT_EQ(summary.contacts, 1U);
  EXPECT_EQ(summary.saturated_ticks, 0U);
  EXPECT_EQ(summary.ticks, 20U);
  EXPECT_DOUBLE_EQ(summary.duration_s, 2.0);
}

TEST(Metrics, SettledEndsAtATenthOfAMillimetre) {
  for (const double amplitude_m : {0.99e-4, 1.01e-4}) {
    Metrics metrics(wall_at_ten_hertz(), 10, true);
    for (std::uint64_t k = 0; k < 10; ++k) metrics.add(at(k, k % 2 == 0 ? 0.0 : amplitude_m, 0.0));
    EXPECT_EQ(metrics.finish().verdict,
              amplitude_m > 1e-4 ? Verdict::kOscillating : Verdict::kSettled);
  }
}

// A square wave between two forces has half their distance as its standard deviation.
TEST(Metrics, BuzzingBeginsAtThreeTenthsOfANewton) {
  for (const double std_n : {0.299, 0.301}) {
    Metrics metrics(wall_at_ten_hertz(), 10, true);
    for (std::uint64_t k = 0; k < 10; ++k) {
      metrics.add(at(k, 0.051, 5.0 + (k % 2 == 0 ? std_n : -std_n)));
    }
    EXPECT_EQ(metrics.finish().verdict, std_n > 0.3 ? Verdict::kBuzzing : Verdict::kSettled);
  }
}

TEST(Metrics, CountsContactsAndSaturation) {
  Metrics metrics(wall_at_ten_hertz(), 6, true);
  const double positions[] = {0.04, 0.051, 0.04, 0.051, 0.052, 0.04};
  for (std::uint64_t k = 0; k < 6; ++k)
    metrics.add(at(k, positions[k], positions[k] > 0.05 ? 8.9 : 0.0));
  const Summary summary = metrics.finish();
  EXPECT_EQ(summary.contacts, 2U);
  EXPECT_EQ(summary.saturated_ticks, 3U);
}

TEST(Metrics, AFigureThatDoesNotApplyIsAbsent) {
  Scene scene = wall_at_ten_hertz();
  Metrics never_touched(scene, 2, false);
  never_touched.add(at(0, 0.0, 0.0));
  EXPECT_FALSE(never_touched.finish().displayed_stiffness_n_per_m.has_value());
  EXPECT_FALSE(never_touched.finish().kinetic_j.has_value());
  EXPECT_FALSE(never_touched.finish().max_penetration_m.has_value());
  scene.x().walls.clear();
  Metrics no_wall(scene, 2, false);
  no_wall.add(at(0, 0.0, 0.0));
  EXPECT_FALSE(no_wall.finish().max_penetration_m.has_value());
}

TEST(Metrics, ARunShorterThanItsTailSaysSo) {
  for (const std::uint64_t ticks : {9U, 10U}) {
    Metrics metrics(wall_at_ten_hertz(), ticks, true);
    for (std::uint64_t k = 0; k < ticks; ++k) metrics.add(at(k, 0.0, 0.0));
    EXPECT_EQ(metrics.finish().verdict_note.has_value(), ticks < 10);
  }
}

TEST(Metrics, ADivergedRunStopsCounting) {
  for (const double bad : {1.5, std::numeric_limits<double>::quiet_NaN()}) {
    Metrics metrics(wall_at_ten_hertz(), 10, true);
    metrics.add(at(0, 0.0, 0.0));
    metrics.add(at(1, bad, 0.0));
    metrics.add(at(2, 0.0, 0.0));
    const Summary summary = metrics.finish();
    EXPECT_EQ(summary.verdict, Verdict::kDiverged);
    EXPECT_EQ(summary.diverged_at_tick, std::optional<std::uint64_t>(1));
    EXPECT_EQ(summary.ticks, 1U);
  }
}

// A handle that jumps does not hide the force that the device was commanded.
TEST(Metrics, OfADeviceEveryCommandedForceCounts) {
  for (const bool has_truth : {false, true}) {
    Metrics metrics(wall_at_ten_hertz(), 10, has_truth);
    metrics.add(at(0, 0.0, 1.0));
    metrics.add(at(1, 1.5, -8.9));
    metrics.add(at(2, 0.0, 2.0));
    metrics.add(at(3, 0.0, std::numeric_limits<double>::infinity()));
    EXPECT_EQ(metrics.finish().peak_force_n, has_truth ? 1.0 : 8.9);
    EXPECT_EQ(metrics.finish().ticks, 1U);
  }
}

// The tail is exactly the last ten ticks: one before it and one inside it tell.
TEST(Metrics, TheTailBeginsAtItsFirstTick) {
  for (const std::uint64_t spike : {9U, 10U}) {
    Metrics metrics(wall_at_ten_hertz(), 20, true);
    for (std::uint64_t k = 0; k < 20; ++k) metrics.add(at(k, k == spike ? 0.01 : 0.0, 0.0));
    EXPECT_EQ(metrics.finish().tail_peak_to_peak_m, spike < 10 ? 0.0 : 0.01);
  }
}

TEST(Metrics, LeastEnergiesAndMarginAreThoseOfTheWholeRun) {
  Metrics metrics(wall_at_ten_hertz(), 4, true);
  const double energies[] = {0.0, -3.0, 2.0, 1.0};
  for (std::uint64_t k = 0; k < 4; ++k) {
    Sample sample = at(k, 0.0, k == 1 ? -4.0 : 1.0);
    sample.energy_cv_j = energies[k];
    sample.energy_scv_j = 2.0 * energies[k];
    sample.truth.actuator_work_j = 3.0 * energies[k];
    sample.truth.dissipation_j = 0.5 * static_cast<double>(k);
    sample.truth.kinetic_j = 0.25 * static_cast<double>(k);
    metrics.add(sample);
  }
  const Summary summary = metrics.finish();
  EXPECT_EQ(summary.min_energy_cv_j, -3.0);
  EXPECT_EQ(summary.min_energy_scv_j, -6.0);
  EXPECT_EQ(summary.passivity_margin_j.value(), -9.0 + 0.5 + 0.25);
  EXPECT_EQ(summary.peak_force_n, 4.0);
}

TEST(Metrics, NamesTheAlgorithmAndItsFollower) {
  Scene scene = wall_at_ten_hertz();
  scene.algorithm.index = *find_algorithm("energy-bounding");
  scene.algorithm.values.at(*find_algorithm_parameter("then")) = 1.0;
  EXPECT_EQ(Metrics(scene, 2, true).finish().algorithm, "energy-bounding then passivity-control");
}

TEST(Metrics, WithoutATickThereIsNoPenetration) {
  EXPECT_FALSE(Metrics(wall_at_ten_hertz(), 2, true).finish().max_penetration_m.has_value());
}

TEST(Metrics, DivergesToBothSides) {
  for (const double bad : {-1.5, 1.5}) {
    Metrics metrics(wall_at_ten_hertz(), 2, true);
    metrics.add(at(0, bad, 0.0));
    EXPECT_EQ(metrics.finish().verdict, Verdict::kDiverged) << bad;
  }
}

TEST(Metrics, ARunThatEndsBeforeItsTailIsNotCalledSettled) {
  Metrics metrics(wall_at_ten_hertz(), 20, true);
  for (std::uint64_t k = 0; k < 5; ++k) metrics.add(at(k, 0.0, 0.0));
  const Summary summary = metrics.finish();
  EXPECT_FALSE(summary.tail_peak_to_peak_m.has_value());
  EXPECT_FALSE(summary.tail_force_mean_n.has_value());
  EXPECT_NE(summary.verdict, Verdict::kSettled);
}

}  // namespace
}  // namespace hapticwall
