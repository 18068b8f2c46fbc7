#include "core/run/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"

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

// A second at 1 kHz, in the wall throughout, with a sine of 50 Hz on position and force.
Summary shaken(
    double swing_m, double force_n, SampleOrigin origin = SampleOrigin::kSimulator,
    double drift_m_per_s = 0.0, const Scene& scene = [] {
      Scene plain = wall_at_ten_hertz();
      plain.sampling.rate_hz = 1000.0;
      return plain;
    }()) {
  constexpr std::uint64_t kTicks = 2000;
  Metrics metrics(scene, kTicks, origin);
  for (std::uint64_t k = 0; k < kTicks; ++k) {
    const double time_s = static_cast<double>(k) * 1e-3;
    const double wave = std::sin(2.0 * std::numbers::pi * 50.0 * time_s);
    Sample sample =
        at(k, 0.055 + 0.5 * swing_m * wave + drift_m_per_s * time_s, 5.0 + force_n * wave);
    if (drift_m_per_s != 0.0) sample.truth.hand_path_m = sample.position_m;
    metrics.add(sample);
  }
  return metrics.finish();
}

// The deviation of a sine is its amplitude over √2, less what the line takes of it.
TEST(Metrics, ChatterAndSwingAreThoseOfASine) {
  const Summary summary = shaken(1e-3, 2.0);
  EXPECT_NEAR(summary.chatter_n.value(), std::numbers::sqrt2, 0.15);
  EXPECT_NEAR(summary.swing_m.value(), 1e-3, 0.1e-3);
  EXPECT_EQ(summary.verdict, Verdict::kOscillating);
}

TEST(Metrics, BuzzingBeginsAtThreeTenthsOfANewtonOrATenthOfTheLimit) {
  const double per_n = shaken(0.0, 1.0).chatter_n.value();
  Scene weak = wall_at_ten_hertz();
  weak.sampling.rate_hz = 1000.0;
  weak.x().device.force_limit_n = 0.5;
  for (const double share : {0.99, 1.01}) {
    const Verdict word = share > 1.0 ? Verdict::kBuzzing : Verdict::kSettled;
    EXPECT_EQ(shaken(0.0, share * 0.3 / per_n).verdict, word);
    EXPECT_EQ(shaken(0.0, share * 0.05 / per_n, SampleOrigin::kSimulator, 0.0, weak).verdict, word);
  }
}

TEST(Metrics, AHandThatMovesIsNoOscillation) {
  EXPECT_EQ(shaken(0.0, 0.0, SampleOrigin::kSimulator, 2e-3).verdict, Verdict::kMoving);
  EXPECT_EQ(shaken(1e-3, 2.0, SampleOrigin::kSimulator, 2e-3).verdict, Verdict::kOscillating);
  EXPECT_EQ(shaken(1e-6, 2.0, SampleOrigin::kSimulator, 2e-3).verdict, Verdict::kBuzzing);
  EXPECT_EQ(shaken(0.0, 0.0, SampleOrigin::kDevice, 2e-3).verdict, Verdict::kMoving);
}

// 10.5 swings in the last second: its end is half a swing away from its begin.
TEST(Metrics, ASlowSwingIsNoDrift) {
  for (const double rate_hz : {2.5, 10.0, 10.5, 11.0}) {
    Scene scene = wall_at_ten_hertz();
    scene.sampling.rate_hz = 1000.0;
    Metrics swing(scene, 2000, SampleOrigin::kSimulator);
    Metrics drift(scene, 2000, SampleOrigin::kSimulator);
    for (std::uint64_t k = 0; k < 2000; ++k) {
      const double time_s = static_cast<double>(k) * 1e-3;
      const double wave = std::cos(2.0 * std::numbers::pi * rate_hz * time_s);
      swing.add(at(k, 0.055 + 0.06e-3 * wave, 0.0));
      drift.add(at(k, 0.055 + 0.06e-3 * time_s * rate_hz, 0.0));
    }
    EXPECT_EQ(swing.finish().verdict, Verdict::kOscillating) << rate_hz;
    EXPECT_EQ(drift.finish().verdict, Verdict::kMoving) << rate_hz;
  }
}

TEST(HandRests, WithinTheTicksAlone) {
  Scene scene = wall_at_ten_hertz();
  EXPECT_TRUE(hand_rests(scene, 0, 10)) << "no hand";
  HandSettings& hand = scene.x().hand.emplace();
  // At rest from tick 10 to 20, and from 30 on.
  hand.path = {{0.0, 0.0}, {1.0, 0.1}, {2.0, 0.1}, {3.0, 0.2}};
  EXPECT_FALSE(hand_rests(scene, 9, 15));
  EXPECT_TRUE(hand_rests(scene, 10, 15));
  EXPECT_TRUE(hand_rests(scene, 10, 21)) << "the last tick is 20";
  EXPECT_FALSE(hand_rests(scene, 10, 22));
  EXPECT_TRUE(hand_rests(scene, 30, 100));
  RecordedPieces recorded;
  recorded.pieces = {{0.0, 0.0, 0.0, 0.1}, {10.0, 10.0, 0.1, 0.0}, {20.0, 20.0, 0.1, 0.1}};
  hand.path = {};
  hand.path.recorded = std::make_shared<const RecordedPieces>(recorded);
  EXPECT_FALSE(hand_rests(scene, 9, 15));
  EXPECT_TRUE(hand_rests(scene, 10, 20));
  EXPECT_FALSE(hand_rests(scene, 10, 25));
  hand.path = {};
  hand.follows_mouse = true;
  EXPECT_FALSE(hand_rests(scene, 0, 10)) << "nobody knows the pointer beforehand";
}

// A run that ends while its script rests is judged as its samples are, whatever comes later.
TEST(HandRests, ARunThatEndsBeforeTheNextMotionAgreesWithItsSamples) {
  Scene scene;
  scene.duration_s = 3.0;
  scene.x().walls = {{0.05, 35e3, 0.0}};
  HandSettings& hand = scene.x().hand.emplace();
  hand.mass_kg = 0.1;
  hand.stiffness_n_per_m = 300.0;
  hand.damping_n_s_per_m = 5.0;
  hand.path = {{0.0, 0.03}, {0.3, 0.06}, {5.0, 0.06}, {6.0, 0.03}};
  Metrics samples(scene, scene.tick_count(), SampleOrigin::kSimulator);
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) { samples.add(sample); };
  const Summary run = simulate(scene, options).summary;
  EXPECT_EQ(run.verdict, samples.finish().verdict);
  EXPECT_EQ(run.chatter_n, samples.finish().chatter_n);
  EXPECT_EQ(run.swing_m, samples.finish().swing_m);
}

// A device cannot see less than a count: √2 counts are added to what rests.
TEST(Metrics, OfADeviceTheCountAddsToTheLimitOfRest) {
  Scene scene = wall_at_ten_hertz();
  scene.sampling.rate_hz = 1000.0;
  scene.x().device.encoder_m = 1e-4;
  const double swing_m = 0.2e-3;
  EXPECT_EQ(shaken(swing_m, 0.0, SampleOrigin::kDevice, 0.0, scene).verdict, Verdict::kSettled);
  EXPECT_EQ(shaken(swing_m, 0.0, SampleOrigin::kSimulator, 0.0, scene).verdict,
            Verdict::kOscillating);
  EXPECT_EQ(shaken(1.5 * swing_m, 0.0, SampleOrigin::kDevice, 0.0, scene).verdict,
            Verdict::kMoving);
}

// The wall gives 6 mW while the hand moves; a device's is judged by the force that it applied.
TEST(Metrics, AWallThatGivesEnergyIsActive) {
  for (const double power_w : {4e-3, 6e-3}) {
    for (const SampleOrigin origin :
         {SampleOrigin::kSimulator, SampleOrigin::kDevice, SampleOrigin::kDeviceWithForce}) {
      Scene scene = wall_at_ten_hertz();
      scene.sampling.rate_hz = 1000.0;
      Metrics metrics(scene, 2000, origin);
      for (std::uint64_t k = 0; k < 2000; ++k) {
        const double time_s = static_cast<double>(k) * 1e-3;
        Sample sample = at(k, 0.06 - 2e-3 * time_s, 1.0);
        sample.truth.hand_path_m = sample.position_m;
        sample.truth.actuator_work_j = -power_w * time_s;
        sample.energy_scv_j = origin == SampleOrigin::kDeviceWithForce ? 0.0 : -power_w * time_s;
        sample.applied_force_n = power_w / 2e-3;
        metrics.add(sample);
      }
      const Summary summary = metrics.finish();
      EXPECT_NEAR(summary.given_w.value(), power_w, 1e-5);
      EXPECT_EQ(summary.verdict, power_w > 5e-3 ? Verdict::kActive : Verdict::kMoving);
    }
  }
}

TEST(Metrics, AWallThatIsNotTouchedHasNoContact) {
  Metrics metrics(wall_at_ten_hertz(), 20, SampleOrigin::kSimulator);
  for (std::uint64_t k = 0; k < 20; ++k) metrics.add(at(k, 0.04, 0.0));
  EXPECT_EQ(metrics.finish().verdict, Verdict::kNoContact);
}

// Five pieces of four ticks at 10 Hz: the fifth is the first that is judged.
TEST(Metrics, ShortTouchesAreNotJudgedAndSaySo) {
  for (const std::uint64_t touching : {16U, 20U}) {
    Metrics metrics(wall_at_ten_hertz(), 40, SampleOrigin::kDevice);
    for (std::uint64_t k = 0; k < 40; ++k) {
      metrics.add(at(k, k < touching ? 0.051 : 0.04, k % 2 == 0 ? 4.0 : 6.0));
    }
    const Summary summary = metrics.finish();
    EXPECT_EQ(summary.chatter_n.has_value(), touching == 20U);
    EXPECT_EQ(summary.verdict_note.has_value(), touching != 20U);
  }
}

// Twenty ticks at 10 Hz: the tail is the last ten.
TEST(Metrics, JudgesTheLastSecond) {
  Metrics metrics(wall_at_ten_hertz(), 20, SampleOrigin::kSimulator);
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
    Metrics metrics(wall_at_ten_hertz(), 10, SampleOrigin::kSimulator);
    for (std::uint64_t k = 0; k < 10; ++k) {
      metrics.add(at(k, k % 3 == 0 ? 0.051 : 0.051 + amplitude_m, 0.0));
    }
    EXPECT_EQ(metrics.finish().verdict,
              amplitude_m > 1e-4 ? Verdict::kOscillating : Verdict::kSettled);
  }
}

TEST(Metrics, CountsContactsAndSaturation) {
  Metrics metrics(wall_at_ten_hertz(), 6, SampleOrigin::kSimulator);
  const double positions[] = {0.04, 0.051, 0.04, 0.051, 0.052, 0.04};
  for (std::uint64_t k = 0; k < 6; ++k)
    metrics.add(at(k, positions[k], positions[k] > 0.05 ? 8.9 : 0.0));
  const Summary summary = metrics.finish();
  EXPECT_EQ(summary.contacts, 2U);
  EXPECT_EQ(summary.saturated_ticks, 3U);
}

TEST(Metrics, AFigureThatDoesNotApplyIsAbsent) {
  Scene scene = wall_at_ten_hertz();
  Metrics never_touched(scene, 2, SampleOrigin::kDevice);
  never_touched.add(at(0, 0.0, 0.0));
  EXPECT_FALSE(never_touched.finish().displayed_stiffness_n_per_m.has_value());
  EXPECT_FALSE(never_touched.finish().kinetic_j.has_value());
  EXPECT_FALSE(never_touched.finish().max_penetration_m.has_value());
  scene.x().walls.clear();
  Metrics no_wall(scene, 2, SampleOrigin::kDevice);
  no_wall.add(at(0, 0.0, 0.0));
  EXPECT_FALSE(no_wall.finish().max_penetration_m.has_value());
}

TEST(Metrics, ARunShorterThanItsTailSaysSo) {
  for (const std::uint64_t ticks : {9U, 10U}) {
    Metrics metrics(wall_at_ten_hertz(), ticks, SampleOrigin::kSimulator);
    for (std::uint64_t k = 0; k < ticks; ++k) metrics.add(at(k, 0.0, 0.0));
    EXPECT_EQ(metrics.finish().verdict_note.has_value(), ticks < 10);
  }
}

TEST(Metrics, ADivergedRunStopsCounting) {
  for (const double bad : {1.5, std::numeric_limits<double>::quiet_NaN()}) {
    Metrics metrics(wall_at_ten_hertz(), 10, SampleOrigin::kSimulator);
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
    Metrics metrics(wall_at_ten_hertz(), 10,
                    has_truth ? SampleOrigin::kSimulator : SampleOrigin::kDevice);
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
    Metrics metrics(wall_at_ten_hertz(), 20, SampleOrigin::kSimulator);
    for (std::uint64_t k = 0; k < 20; ++k) metrics.add(at(k, k == spike ? 0.01 : 0.0, 0.0));
    EXPECT_EQ(metrics.finish().tail_peak_to_peak_m, spike < 10 ? 0.0 : 0.01);
  }
}

TEST(Metrics, LeastEnergiesAndMarginAreThoseOfTheWholeRun) {
  Metrics metrics(wall_at_ten_hertz(), 4, SampleOrigin::kSimulator);
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
  EXPECT_EQ(Metrics(scene, 2, SampleOrigin::kSimulator).finish().algorithm,
            "energy-bounding then passivity-control");
}

TEST(Metrics, WithoutATickThereIsNoPenetration) {
  EXPECT_FALSE(Metrics(wall_at_ten_hertz(), 2, SampleOrigin::kSimulator)
                   .finish()
                   .max_penetration_m.has_value());
}

TEST(Metrics, DivergesToBothSides) {
  for (const double bad : {-1.5, 1.5}) {
    Metrics metrics(wall_at_ten_hertz(), 2, SampleOrigin::kSimulator);
    metrics.add(at(0, bad, 0.0));
    EXPECT_EQ(metrics.finish().verdict, Verdict::kDiverged) << bad;
  }
}

TEST(Metrics, ARunThatEndsBeforeItsTailIsNotCalledSettled) {
  Metrics metrics(wall_at_ten_hertz(), 20, SampleOrigin::kSimulator);
  for (std::uint64_t k = 0; k < 5; ++k) metrics.add(at(k, 0.0, 0.0));
  const Summary summary = metrics.finish();
  EXPECT_FALSE(summary.tail_peak_to_peak_m.has_value());
  EXPECT_FALSE(summary.tail_force_mean_n.has_value());
  EXPECT_NE(summary.verdict, Verdict::kSettled);
}

}  // namespace
}  // namespace hapticwall
