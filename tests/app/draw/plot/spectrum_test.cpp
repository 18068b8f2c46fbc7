#include "app/draw/plot/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <numbers>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/samples.h"

namespace hapticwall::draw {
namespace {

constexpr double kRateHz = 1000.0;

SampleHistory history_of(std::uint64_t count, const std::function<double(double)>& force) {
  SampleHistory history(static_cast<std::size_t>(count));
  for (std::uint64_t tick = 0; tick < count; ++tick) {
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) / kRateHz;
    sample.force_n = force(sample.time_s);
    history.push(sample);
  }
  return history;
}

std::optional<SpectralLine> line_of(const SampleHistory& history,
                                    Quantity quantity = &Sample::force_n) {
  return strongest_line(spectrum_of(history, quantity, {0, history.size()}));
}

TEST(Spectrum, FindsASineAndItsAmplitudeBesideItsMean) {
  for (const double frequency_hz : {3.0, 49.8, 123.456, 444.4}) {
    const auto line = line_of(history_of(6000, [=](double time_s) {
      return 100.0 + 2.5 * std::sin(2.0 * std::numbers::pi * frequency_hz * time_s + 0.7);
    }));
    ASSERT_TRUE(line.has_value());
    EXPECT_NEAR(line->frequency_hz, frequency_hz, 0.02);
    EXPECT_NEAR(line->amplitude, 2.5, 0.05);
  }
}

// Against the sum that defines it.
TEST(Spectrum, IsTheFourierSumOfTheWindowedSamples) {
  constexpr std::size_t kTaken = 64;
  const auto force = [](double time_s) { return std::fmod(7919.0 * time_s, 1.3); };
  const SampleHistory history = history_of(kTaken, force);
  const Spectrum spectrum = spectrum_of(history, &Sample::force_n, {0, kTaken});
  ASSERT_EQ(spectrum.amplitude.size(), kTaken / 2);
  EXPECT_NEAR(spectrum.step_hz, kRateHz / kTaken, 1e-9);
  const double mean = history.stats(&Sample::force_n, {0, kTaken}).mean();
  for (std::size_t k = 1; k < kTaken / 2; ++k) {
    std::complex<double> sum;
    for (std::size_t i = 0; i < kTaken; ++i) {
      const double hann =
          0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / kTaken);
      const double turns = static_cast<double>(k * i % kTaken) / kTaken;
      sum += hann * (history.value(&Sample::force_n, i) - mean) *
             std::polar(1.0, -2.0 * std::numbers::pi * turns);
    }
    // The sum of the window is half of its length.
    ASSERT_NEAR(spectrum.amplitude[k], 4.0 * std::abs(sum) / kTaken, 1e-12) << k;
  }
}

TEST(Spectrum, OfALongRangeIsThatOfItsNewestSamples) {
  const SampleHistory history = history_of(40'000, [](double time_s) {
    return std::sin(2.0 * std::numbers::pi * (time_s < 20.0 ? 100.0 : 30.0) * time_s);
  });
  EXPECT_NEAR(line_of(history)->frequency_hz, 30.0, 0.02);
}

TEST(Spectrum, OfNothingHasNoLine) {
  EXPECT_FALSE(line_of(history_of(5, [](double time_s) { return time_s; })).has_value());
  EXPECT_FALSE(line_of(history_of(500, [](double) { return 4.0; })).has_value());
  EXPECT_FALSE(line_of(history_of(500, [](double) { return 4.0; }), Derived::kStiffness))
      << "every sample is masked";
}

// The limit cycle of a bare wall under a firm press.
TEST(Spectrum, ThePressWithoutAnAlgorithmShakesWithFiftyHertz) {
  Scene scene = file::load_scene("press")->scene;
  scene.algorithm.index = *find_algorithm("none");
  const std::vector<Sample> samples = testing::samples_of(scene);
  SampleHistory history(samples.size());
  history.push(samples);
  const auto line = strongest_line(
      spectrum_of(history, &PlantTruth::position_m, {history.size() - 3000, history.size()}));
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(line->frequency_hz, 49.8, 0.5);
}

}  // namespace
}  // namespace hapticwall::draw
