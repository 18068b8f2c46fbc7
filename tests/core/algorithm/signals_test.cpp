// The numbers that the algorithms show of themselves, on moves that a person can follow by hand: b
// = 1 N·s/m and T = 1 ms, so that b/T = 1000 N/m, and a wall of 10 kN/m at zero.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/run/simulate.h"
#include "core/scene_keys.h"
#include "core/tick/servo.h"
#include "tests/position_bench.h"

namespace hapticwall {
namespace {

using testing::PositionBench;
using testing::set_parameter;

constexpr double kRounding = 1e-12;

ServoSettings settings_under(std::string_view algorithm) {
  ServoSettings settings;
  settings.device_damping_n_s_per_m = 1.0;
  const std::array<WallSettings, 1> walls{WallSettings{0.0, 10e3, 0.0}};
  settings.walls = WallSet(walls);
  settings.algorithm.index = find_algorithm(algorithm).value();
  return settings;
}

double signal(const Sample& sample, std::string_view name) {
  return sample.signals.at(find_algorithm_signal(name).value());
}

TEST(Signals, OfEnergyBoundingAreTheBoundOfTheStep) {
  ServoSettings settings = settings_under("energy-bounding");
  PositionBench free(settings);
  EXPECT_TRUE(std::isnan(signal(free.move_to(0.0), "step_bound_n"))) << "no bound at rest";
  EXPECT_NEAR(signal(free.move_to(0.1e-3), "step_bound_n"), 0.1, kRounding);
  set_parameter(settings.algorithm, "rest_force_step_n", 0.05);
  PositionBench bench(settings);
  EXPECT_NEAR(signal(bench.move_to(0.0), "step_bound_n"), 0.05, kRounding);
}

TEST(Signals, OfEnergyBounding2010AreTheBoundAndTheStore) {
  PositionBench bench(settings_under("energy-bounding-2010"));
  bench.move_to(0.0);
  const Sample sample = bench.move_to(0.1e-3);
  EXPECT_NEAR(signal(sample, "step_bound_n"), 0.1, kRounding);
  EXPECT_NEAR(sample.force_n, 0.1, kRounding);
  EXPECT_NEAR(signal(sample, "store_j"), 0.1 * 0.1 / 2000.0, kRounding);
}

TEST(Signals, OfForceBoundingAreTheEnergyAndTheForceThatItAllows) {
  PositionBench bench(settings_under("force-bounding"));
  bench.move_to(0.0);
  const Sample sample = bench.move_to(0.1e-3);
  EXPECT_NEAR(signal(sample, "gathered_energy_j"), 1e-5, kRounding);  // (b/T) Δx²
  EXPECT_NEAR(signal(sample, "force_bound_n"), 0.2, kRounding);       // √(4 (b/T) E)
  EXPECT_NEAR(sample.force_n, 0.2, kRounding);
}

TEST(Signals, OfTheEnergyLimitedSpringAreTheEnergyAndTheForceThatItAllows) {
  PositionBench bench(settings_under("energy-limited-spring"));
  bench.move_to(0.1e-3);
  const double before_n = bench.move_to(0.1e-3).force_n;
  EXPECT_NEAR(before_n, 0.2, kRounding);  // (2b/T) p
  const Sample sample = bench.move_to(0.2e-3);
  EXPECT_NEAR(signal(sample, "gathered_energy_j"), 0.2 * 0.1e-3, kRounding);
  EXPECT_NEAR(signal(sample, "force_bound_n"), std::sqrt(2.0 * 10e3 * 2e-5), kRounding);
}

TEST(Signals, OfHalfSampleAreThePenetrationAhead) {
  PositionBench bench(settings_under("half-sample"));
  bench.move_to(0.1e-3);
  EXPECT_NEAR(signal(bench.move_to(0.3e-3), "ahead_penetration_m"), 0.4e-3, kRounding);
}

TEST(Signals, OfTheVirtualCouplingAreTheProxy) {
  PositionBench bench(settings_under("virtual-coupling"));
  const Sample sample = bench.move_to(0.6e-3);
  EXPECT_NEAR(signal(sample, "proxy_penetration_m"), 0.1e-3, kRounding);  // p K_c/(K + K_c)
  EXPECT_NEAR(sample.force_n, 1.0, kRounding);
}

TEST(Signals, OfPassivityControlAreTheObserverAndItsDamper) {
  ServoSettings settings = settings_under("passivity-control");
  set_parameter(settings.algorithm, "observer", 1.0);  // held-force
  set_parameter(settings.algorithm, "damping_credit", 1.0);
  PositionBench bench(settings);
  bench.move_to(0.1e-3);
  EXPECT_EQ(signal(bench.move_to(0.1e-3), "injected_damping_n_s_per_m"), 0.0);
  const Sample out = bench.move_to(0.0);
  EXPECT_NEAR(signal(out, "observed_energy_j"), -1e-4, kRounding);         // F_d(k-1) Δx
  EXPECT_NEAR(signal(out, "credit_j"), 1e-5, kRounding);                   // (b/T) Δx²
  EXPECT_NEAR(signal(out, "injected_damping_n_s_per_m"), 1.0, kRounding);  // α_max = b
  EXPECT_NEAR(out.force_n, -0.1, kRounding);
}

TEST(Signals, OfAnAlgorithmStandBesideThoseOfItsFollower) {
  ServoSettings settings = settings_under("force-bounding");
  set_parameter(settings.algorithm, "then", 1.0);
  PositionBench bench(settings);
  bench.move_to(0.0);
  const Sample sample = bench.move_to(0.1e-3);
  EXPECT_NEAR(signal(sample, "force_bound_n"), 0.2, kRounding);
  EXPECT_NEAR(signal(sample, "observed_energy_j"), 0.2 * 0.1e-3, kRounding);
  EXPECT_EQ(signal(sample, "injected_damping_n_s_per_m"), 0.0) << "from the first force on";
}

TEST(Signals, EndWithTheirAlgorithm) {
  PositionBench bench(settings_under("force-bounding"));
  EXPECT_FALSE(std::isnan(signal(bench.move_to(1e-3), "gathered_energy_j")));
  bench.servo().apply(settings_under("half-sample"));
  const Sample sample = bench.move_to(1e-3);
  EXPECT_TRUE(std::isnan(signal(sample, "gathered_energy_j")));
  EXPECT_FALSE(std::isnan(signal(sample, "ahead_penetration_m")));
}

// ---- in a headless run ----

Scene pressed(const AlgorithmDescription& algorithm) {
  Scene scene;
  scene.duration_s = 0.3;
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().device.damping_n_s_per_m = 1.0;
  scene.x().walls = {{1e-3, 10e3, 0.0}};
  scene.x().hand = HandSettings{};
  scene.x().hand->path = {{0.0, 0.0}, {0.1, 5e-3}, {0.2, 0.0}};
  scene.algorithm.index = *find_algorithm(algorithm.name);
  return scene;
}

std::vector<Sample> run_of(const Scene& scene, bool signals) {
  std::vector<Sample> samples;
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) { samples.push_back(sample); };
  options.signals = signals;
  static_cast<void>(simulate(scene, options));
  return samples;
}

bool has(const AlgorithmDescription& algorithm, std::string_view signal) {
  return std::ranges::any_of(algorithm.signals,
                             [&](const SignalDescription& own) { return own.name == signal; });
}

TEST(Signals, OfARunAreThoseOfItsAlgorithmInEveryTick) {
  for (const AlgorithmDescription& algorithm : algorithms()) {
    const std::vector<Sample> samples = run_of(pressed(algorithm), true);
    ASSERT_EQ(samples.size(), 300U);
    for (const SignalDescription& signal_of : algorithm_signals()) {
      const auto given = std::ranges::count_if(samples, [&](const Sample& sample) {
        return std::isfinite(signal(sample, signal_of.name));
      });
      EXPECT_EQ(given, has(algorithm, signal_of.name) ? 300 : 0)
          << algorithm.name << ' ' << signal_of.name;
    }
  }
}

// The headless loop against the one of live sessions, where each tick starts without signals.
void expect_the_same_signals_in_both_loops(std::optional<double> encoder_m) {
  for (const AlgorithmDescription& algorithm : algorithms()) {
    Scene scene = pressed(algorithm);
    scene.x().device.encoder_m = encoder_m;
    // The handle starts within the wall, is thrown out and comes to rest.
    scene.x().device.start_m = 2e-3;
    scene.x().device.friction_n = 0.5;
    const std::vector<Sample> samples = run_of(scene, true);
    PositionBench bench(servo_settings(scene));
    for (const Sample& sample : samples) {
      const Sample live = bench.move_to(sample.position_m);
      for (std::size_t i = 0; i < algorithm_signals().size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(live.signals[i]),
                  std::bit_cast<std::uint64_t>(sample.signals[i]))
            << algorithm.name << ' ' << algorithm_signals()[i].name << ' ' << sample.tick;
      }
    }
  }
}

TEST(Signals, AreTheSameBitsInEveryLoop) { expect_the_same_signals_in_both_loops(0.254e-3); }

// Energy bounding shows no bound in a tick of rest then.
TEST(Signals, AreTheSameBitsInEveryLoopWithoutAnEncoder) {
  expect_the_same_signals_in_both_loops(std::nullopt);
}

TEST(Signals, ChangeNoBitOfTheRunAndAreAbsentUnasked) {
  for (const AlgorithmDescription& algorithm : algorithms()) {
    const std::vector<Sample> with = run_of(pressed(algorithm), true);
    const std::vector<Sample> without = run_of(pressed(algorithm), false);
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
      EXPECT_TRUE(all_columns(
          with[i], without[i],
          [](const SampleColumn& /*column*/, const auto& a, const auto& b) { return a == b; }));
      EXPECT_TRUE(
          std::ranges::all_of(without[i].signals, [](double value) { return std::isnan(value); }));
    }
  }
}

}  // namespace
}  // namespace hapticwall
