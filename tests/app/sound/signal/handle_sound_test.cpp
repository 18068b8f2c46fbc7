#include "app/sound/signal/handle_sound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "tests/spectrum.h"

namespace hapticwall::sound::test {
namespace {

constexpr double kRateHz = 1000.0;

// Swings at `hz` with 1 m/s, with a measured velocity of half of that.
Sample swinging(std::uint64_t tick, double hz) {
  Sample sample;
  sample.tick = tick;
  const double turns = hz * static_cast<double>(tick) / kRateHz;
  sample.truth.velocity_m_per_s = std::sin(2.0 * std::numbers::pi * turns);
  sample.velocity_m_per_s = 0.5 * sample.truth.velocity_m_per_s;
  return sample;
}

double amplitude_of(HandleSound& sound, double hz) {
  std::vector<double> heard;
  for (std::uint64_t i = 0; i < 3000; ++i) heard.push_back(sound.next(swinging(i, hz)));
  return hapticwall::test::line_at(std::span<const double>(heard).subspan(1000), kRateHz, hz);
}

Sample moving(std::uint64_t tick, double velocity_m_per_s, std::uint32_t flags = 0) {
  Sample sample;
  sample.tick = tick;
  sample.truth.velocity_m_per_s = velocity_m_per_s;
  sample.flags = flags;
  return sample;
}

TEST(HandleSound, IsTheTrueAccelerationOfASimulator) {
  for (const double hz : {50.0, 100.0, 250.0}) {
    HandleSound sound(kRateHz, true);
    const double difference = 2.0 * kRateHz * std::sin(std::numbers::pi * hz / kRateHz);
    const double high_pass = 1.0 / std::hypot(1.0, kLowestHz / hz);
    EXPECT_NEAR(amplitude_of(sound, hz) / (difference * high_pass), 1.0, 0.05) << hz;
  }
}

TEST(HandleSound, HasNoConstantPart) {
  HandleSound sound(kRateHz, true);
  double value = 0.0;
  for (std::uint64_t i = 0; i < 1000; ++i)
    value = sound.next(moving(i, 0.01 * static_cast<double>(i)));
  EXPECT_NEAR(value, 0.0, 1e-6);
}

// The second low-pass counts the first one's 3 dB again.
TEST(HandleSound, OfADeviceIsWhatIsMeasuredAndSmoother) {
  HandleSound truth(kRateHz, true);
  HandleSound measured(kRateHz, false);
  EXPECT_NEAR(amplitude_of(measured, 25.0) / amplitude_of(truth, 25.0), 0.5, 0.04);
  HandleSound truth_above(kRateHz, true);
  HandleSound measured_above(kRateHz, false);
  EXPECT_LT(amplitude_of(measured_above, 300.0) / amplitude_of(truth_above, 300.0), 0.08);
}

TEST(HandleSound, ATouchClicksByItsSpeed) {
  for (const double speed : {0.1, 0.2}) {
    HandleSound sound(kRateHz, true);
    double loudest = 0.0;
    double late = 0.0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const double value = sound.next(moving(i, speed, i < 100 ? 0U : kFlagInContact));
      if (i < 100) EXPECT_EQ(value, 0.0);
      loudest = std::max(loudest, std::abs(value));
      if (i > 180) late = std::max(late, std::abs(value));
    }
    EXPECT_GT(loudest, 0.6 * kClickPerSpeed * speed);
    EXPECT_LT(loudest, kClickPerSpeed * speed);
    EXPECT_LT(late, 1e-3 * loudest);
  }
}

// Only the first touch of a limit cycle of 50 Hz clicks.
TEST(HandleSound, ATouchSoonAfterAnotherHasNoClick) {
  HandleSound sound(kRateHz, true);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double value = sound.next(moving(i, 0.2, i % 20 < 10 ? kFlagInContact : 0U));
    if (i > 150) EXPECT_NEAR(value, 0.0, 1e-6);
  }
}

TEST(HandleSound, AGapAFaultAndNoNumberAreSilent) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Sample& odd : {moving(500, 3.0), moving(100, 3.0, kFlagDeviceFault),
                            moving(100, 3.0, kFlagStaleInput), moving(100, kNan), moving(0, 3.0)}) {
    HandleSound sound(kRateHz, true);
    for (std::uint64_t i = 0; i < 100; ++i) EXPECT_EQ(sound.next(moving(i, 0.0)), 0.0);
    EXPECT_EQ(sound.next(odd), 0.0);
    const bool unknown = odd.flags != 0 || std::isnan(odd.truth.velocity_m_per_s);
    EXPECT_EQ(sound.next(moving(odd.tick + 1, unknown ? 0.0 : 3.0)), 0.0);
  }
}

}  // namespace
}  // namespace hapticwall::sound::test
