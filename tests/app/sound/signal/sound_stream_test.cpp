#include "app/sound/signal/sound_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hapticwall::sound::test {
namespace {

std::vector<float> heard(int axes, double speed) {
  SoundStream stream(1000.0, 48000.0, true);
  std::vector<float> out;
  for (std::uint64_t i = 0; i < 200; ++i) {
    Tick tick;
    tick.count = static_cast<std::uint8_t>(axes);
    for (Sample& sample : tick.in_use()) {
      sample.tick = i;
      sample.truth.velocity_m_per_s = i < 100 ? 0.0 : speed;
    }
    stream.take(tick, out);
  }
  stream.finish(out);
  return out;
}

double loudest(const std::vector<float>& samples) {
  double most = 0.0;
  for (const float sample : samples) most = std::max(most, std::abs(static_cast<double>(sample)));
  return most;
}

TEST(SoundStream, TheLimitIsSmoothAndNeverReached) {
  double previous = -1.0;
  for (double value = -3.0; value <= 3.0; value += 0.01) {
    const double limited = soft_limited(value);
    EXPECT_GT(limited, previous);
    EXPECT_LT(std::abs(limited), 1.0);
    if (std::abs(value) < kLinearShare) EXPECT_EQ(limited, value);
    if (value > -3.0) EXPECT_LE(limited - previous, 0.0101);
    previous = limited;
  }
}

// A jump of speed in one tick.
TEST(SoundStream, HasAFixedGain) {
  const double quiet = loudest(heard(1, 0.02));
  EXPECT_NEAR(quiet, 0.8 * 0.02 * 1000.0 / kFullScaleMPerS2, 0.015);
  EXPECT_NEAR(loudest(heard(1, 0.04)) / quiet, 2.0, 1e-3);
  EXPECT_NEAR(loudest(heard(2, 0.02)) / quiet, 2.0, 1e-3);
}

TEST(SoundStream, NeverClips) {
  EXPECT_LE(loudest(heard(2, 1e3)), 1.0);
  EXPECT_GT(loudest(heard(2, 1e3)), 0.99);
}

TEST(SoundStream, AFileHasTheTimeOfItsTicks) {
  EXPECT_NEAR(static_cast<double>(heard(1, 0.02).size()), 199.0 * 48.0, 1.0);
}

}  // namespace
}  // namespace hapticwall::sound::test
