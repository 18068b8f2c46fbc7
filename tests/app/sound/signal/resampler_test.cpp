#include "app/sound/signal/resampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "tests/spectrum.h"

namespace hapticwall::sound::test {
namespace {

using hapticwall::test::decibels;
using hapticwall::test::line_at;
using hapticwall::test::strongest_line;

// A sine of amplitude 1, without the transients at its ends.
std::vector<float> resampled_sine(double hz, double from_hz, double to_hz, double seconds) {
  Resampler resampler(from_hz, to_hz);
  std::vector<float> out;
  const auto inputs = static_cast<int>((seconds + 4.0 * resampler.delay_s()) * from_hz);
  for (int i = 0; i < inputs; ++i)
    resampler.push(std::sin(2.0 * std::numbers::pi * hz * i / from_hz), out);
  const auto cut = static_cast<std::ptrdiff_t>(2.0 * resampler.delay_s() * to_hz);
  return {out.begin() + cut, out.begin() + cut + static_cast<std::ptrdiff_t>(seconds * to_hz)};
}

struct Rates {
  double from_hz;
  double to_hz;
};
constexpr std::array kRates{Rates{100.0, 48000.0}, Rates{1000.0, 44100.0}, Rates{1000.0, 48000.0},
                            Rates{3000.0, 44100.0}, Rates{20000.0, 48000.0}};

// The strongest line beside the signal's own, where the window of the test has fallen to -80 dB.
double strongest_beside(std::span<const float> heard, double to_hz, double hz, double top_hz) {
  const double bin_hz = to_hz / static_cast<double>(heard.size());
  const double apart_hz = 16.0 * bin_hz;
  return std::max(strongest_line(heard, to_hz, 0.0, hz - apart_hz, 0.5 * bin_hz).amplitude,
                  strongest_line(heard, to_hz, hz + apart_hz, top_hz, 0.5 * bin_hz).amplitude);
}

TEST(Resampler, ALineKeepsItsLevelAndHasNoImages) {
  double strongest_db = -200.0;
  for (const auto& [from_hz, to_hz] : kRates) {
    for (const double share : {0.15, 0.3, 0.45}) {
      const double band_hz = std::min(from_hz, kMaxBandHz);
      const double hz = share * band_hz;
      const std::vector<float> heard = resampled_sine(hz, from_hz, to_hz, 200.0 / band_hz);
      if (share <= 0.3)
        EXPECT_NEAR(line_at(std::span<const float>(heard), to_hz, hz), 1.0, 0.002) << from_hz;
      const double top_hz = std::min(2.5 * from_hz, 0.5 * to_hz);
      const double beside = strongest_beside(heard, to_hz, hz, top_hz);
      EXPECT_LT(decibels(beside), -65.0) << from_hz << " Hz, " << hz << " Hz";
      strongest_db = std::max(strongest_db, decibels(beside));
    }
  }
  RecordProperty("strongest_image_db", std::to_string(strongest_db));
}

TEST(Resampler, ALineInTheStopBandIsGone) {
  const std::vector<float> heard = resampled_sine(0.52 * kMaxBandHz, 20000.0, 48000.0, 0.2);
  EXPECT_LT(decibels(hapticwall::test::rms(std::span<const float>(heard))), -63.0);
}

TEST(Resampler, TheFirstOutputHasTheTimeOfTheFirstInput) {
  Resampler resampler(1000.0, 48000.0);
  std::vector<float> out;
  for (int i = 0; i < 200; ++i) resampler.push(i == 100 ? 1.0 : 0.0, out);
  const auto top = std::max_element(out.begin(), out.end()) - out.begin();
  EXPECT_EQ(top, 4800);
  EXPECT_DOUBLE_EQ(resampler.delay_s(), 0.01);
}

TEST(Resampler, ACorrectionChangesTheNumberOfOutputs) {
  for (const double share : {-0.005, 0.0, 0.005}) {
    Resampler resampler(1000.0, 48000.0);
    resampler.correct(share);
    std::vector<float> out;
    for (int i = 0; i < 10000; ++i) resampler.push(0.0, out);
    EXPECT_NEAR(static_cast<double>(out.size()) * (1.0 + share), 9990.0 * 48.0, 50.0);
  }
}

}  // namespace
}  // namespace hapticwall::sound::test
