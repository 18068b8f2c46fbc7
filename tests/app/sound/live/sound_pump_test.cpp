#include "app/sound/live/sound_pump.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/app/sound/live/card_rig.h"
#include "tests/spectrum.h"

namespace hapticwall::sound::test {
namespace {

constexpr double kMaxLatencyS = 0.030;

double still(std::uint64_t /*tick*/) { return 0.0; }
double humming(std::uint64_t tick) {
  return 0.3 * std::sin(2.0 * std::numbers::pi * 0.05 * static_cast<double>(tick));
}

// The time from a tick with a jump of speed to the peak that the card plays.
double latency_of_a_jump(CardRig& rig, double after_s) {
  rig.run(rig.now_s() + after_s, still);
  const std::uint64_t at = rig.ticks;
  rig.push_tick(still);
  const std::size_t begin = rig.heard.size();
  const double jump_s = rig.tick_s;
  const double speed = 50.0 / rig.rate_hz;
  rig.run(jump_s + 0.3, [=](std::uint64_t tick) { return tick > at ? speed : 0.0; });
  const auto peak =
      std::max_element(rig.heard.begin() + static_cast<std::ptrdiff_t>(begin), rig.heard.end());
  EXPECT_GT(*peak, 0.05F);
  return rig.heard_at_s[static_cast<std::size_t>(peak - rig.heard.begin())] - jump_s;
}

TEST(SoundPump, IsLessThanThirtyMillisecondsLateAndSaysSo) {
  double longest_s = 0.0;
  for (const double after_s : {0.3, 0.3013, 0.5021, 0.8507}) {
    CardRig rig;
    const double latency_s = latency_of_a_jump(rig, after_s);
    EXPECT_LT(latency_s, kMaxLatencyS);
    EXPECT_NEAR(latency_s, rig.pump.latency_s(), 0.004);
    longest_s = std::max(longest_s, latency_s);
  }
  RecordProperty("latency_ms", std::to_string(1e3 * longest_s));
}

TEST(SoundPump, IsLateByTheFilterOfASlowLoop) {
  CardRig fast(10000.0);
  EXPECT_LT(latency_of_a_jump(fast, 0.3), 0.018);
  CardRig slow(100.0);
  const double latency_s = latency_of_a_jump(slow, 0.3);
  EXPECT_GT(latency_s, 0.1);
  EXPECT_NEAR(latency_s, slow.pump.latency_s(), 0.02);
}

// 40 s, a loop whose clock is wrong by 0.3 %: without a control the ring is empty, or full,
// after 2 s.
TEST(SoundPump, ADriftOfTheClocksIsAbsorbed) {
  for (const double error : {-0.003, 0.0, 0.003}) {
    CardRig rig;
    rig.loop_error = error;
    rig.run(40.0, humming);
    EXPECT_EQ(rig.gaps, 0) << error;
    EXPECT_EQ(rig.lost, 0) << error;
    EXPECT_LT(rig.pump.latency_s(), kMaxLatencyS);
    const double expected = 40.0 * rig.card.rate_hz;
    EXPECT_NEAR(static_cast<double>(rig.heard.size()), expected, 0.01 * expected);
    const std::span<const float> end = std::span(rig.heard).last(48000);
    const double hz = 50.0 * (1.0 + error);
    EXPECT_NEAR(hapticwall::test::strongest_line(end, 48000.0, 40.0, 60.0, 0.05).hz, hz, 0.1);
    EXPECT_GT(hapticwall::test::rms(end), 0.2);
  }
}

// Beyond ±0.5 % the sound has gaps, but its delay does not grow.
TEST(SoundPump, ALargerDriftGivesGapsAndNoDelay) {
  for (const double error : {-0.02, 0.02}) {
    CardRig rig;
    rig.loop_error = error;
    rig.run(20.0, humming);
    EXPECT_LT(latency_of_a_jump(rig, 0.1), 0.05) << error;
  }
}

TEST(SoundPump, ACardThatSleptIsNotBehindAfterwards) {
  CardRig rig;
  rig.run(1.0, humming);
  rig.card_sleeps = true;
  rig.run(3.0, humming);
  EXPECT_EQ(rig.lost, 0);
  rig.card_sleeps = false;
  rig.run(3.2, humming);
  EXPECT_LT(latency_of_a_jump(rig, 0.2), kMaxLatencyS);
}

// A paused loop: the sound fades, and comes back.
TEST(SoundPump, WithoutTicksThereIsSilence) {
  CardRig rig;
  rig.run(1.0, humming);
  const double resumes_s = 2.0;
  rig.tick_s = resumes_s;
  rig.run(resumes_s, humming);
  const std::span<const float> paused = std::span(rig.heard).last(24000);
  EXPECT_LT(hapticwall::test::rms(paused), 1e-6);
  rig.run(3.0, humming);
  EXPECT_GT(hapticwall::test::rms(std::span<const float>(rig.heard).last(24000)), 0.2);
}

TEST(SoundPump, DropsTicksThatWaitedTooLong) {
  CardRig rig;
  for (int i = 0; i < 500; ++i) rig.push_tick(humming);
  rig.step();
  EXPECT_EQ(rig.feed->ticks.size(), 0U);
  EXPECT_EQ(rig.ring.size(), 0U);
  for (int i = 0; i < 30; ++i) rig.push_tick(humming);
  rig.step();
  EXPECT_GT(rig.ring.size(), 15U * 48U);
  EXPECT_LE(rig.ring.size(), 30U * 48U);
}

TEST(SoundPump, TheVolumeScalesTheSound) {
  CardRig loud;
  CardRig quiet;
  quiet.mix.volume = 0.25;
  loud.run(2.0, humming);
  quiet.run(2.0, humming);
  for (std::size_t i = 0; i < loud.heard.size(); ++i)
    ASSERT_NEAR(quiet.heard[i], 0.25F * loud.heard[i], 1e-6F);
}

// The blind test: nothing of the handle is in it.
TEST(SoundPump, MaskingNoiseIsTheSameForEveryHandle) {
  CardRig quiet;
  CardRig buzzing;
  quiet.mix.masked = buzzing.mix.masked = true;
  quiet.run(2.0, still);
  buzzing.run(2.0, humming);
  EXPECT_TRUE(quiet.heard == buzzing.heard);
  EXPECT_GT(hapticwall::test::rms(std::span<const float>(quiet.heard).last(48000)), 0.15);
}

TEST(MaskingNoise, FallsOverTheBandOfTheSound) {
  MaskingNoise noise(48000.0);
  std::vector<double> samples(480000);
  for (double& sample : samples) sample = noise.next();
  const std::span<const double> all = samples;
  EXPECT_NEAR(hapticwall::test::rms(all), 0.2, 0.02);
  EXPECT_LE(*std::ranges::max_element(samples), 1.0);
  // The mean power of 40 lines about each frequency; 3 octaves of 3 dB.
  const auto power = [&](double hz) {
    double sum = 0.0;
    for (int i = 0; i < 40; ++i)
      sum += std::pow(hapticwall::test::line_at(all.first(96000), 48000.0, hz + 1.0 * i), 2.0);
    return sum;
  };
  EXPECT_NEAR(10.0 * std::log10(power(50.0) / power(400.0)), 9.0, 3.0);
}

}  // namespace
}  // namespace hapticwall::sound::test
