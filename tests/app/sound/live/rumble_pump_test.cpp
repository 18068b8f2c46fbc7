#include "app/sound/live/rumble_pump.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/app/sound/live/fake_gamepad.h"

namespace hapticwall::sound::test {
namespace {

constexpr double kFullLevel = 65535.0;

struct TimedLevels {
  double time_s;
  RumbleLevels levels;
};

// A gamepad that is given a tick every millisecond.
struct Pad {
  explicit Pad(double volume = 1.0) : mix{volume, false} {}

  void take(const Sample& sample) {
    Tick tick;
    tick.axes[0] = sample;
    EXPECT_FALSE(pump.step(std::span(&tick, 1), mix));
    for (const std::vector<RumbleLevels> all = felt->calls(); calls.size() < all.size();)
      calls.push_back({sample.time_s, all[calls.size()]});
  }
  // 2 πf · speed is the acceleration.
  void swing(std::uint64_t from, std::uint64_t to, double hz, double speed) {
    for (std::uint64_t i = from; i < to; ++i) {
      Sample sample;
      sample.tick = i;
      sample.time_s = 0.001 * static_cast<double>(i);
      sample.truth.velocity_m_per_s = speed * std::sin(2.0 * std::numbers::pi * hz * sample.time_s);
      take(sample);
    }
  }
  [[nodiscard]] std::vector<RumbleLevels> between(double from_s, double to_s) const {
    std::vector<RumbleLevels> part;
    for (const TimedLevels& call : calls)
      if (call.time_s >= from_s && call.time_s < to_s) part.push_back(call.levels);
    return part;
  }

  std::shared_ptr<Felt> felt = std::make_shared<Felt>();
  FakeGamepad gamepad{felt};
  RumblePump pump{{nullptr, 1000.0, true}, gamepad};
  SoundMix mix;
  std::vector<TimedLevels> calls;
};

// 0 where there are none.
std::uint16_t strongest(const std::vector<RumbleLevels>& all) {
  std::uint16_t most = 0;
  for (const RumbleLevels& levels : all) most = std::max(most, levels.strong);
  return most;
}
std::uint16_t weakest(const std::vector<RumbleLevels>& all) {
  std::uint16_t least = strongest(all);
  for (const RumbleLevels& levels : all) least = std::min(least, levels.strong);
  return least;
}

// Returns the time of the first contact.
double play(Pad& pad, const std::string& scene_name, const std::string& algorithm) {
  Scene scene = file::load_scene(scene_name)->scene;
  scene.algorithm.index = *find_algorithm(algorithm);
  double touch_s = -1.0;
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) {
    if (touch_s < 0.0 && (sample.flags & kFlagInContact) != 0) touch_s = sample.time_s;
    pad.take(sample);
  };
  static_cast<void>(simulate(scene, options));
  return touch_s;
}

TEST(RumblePump, ALimitCycleIsSteadyAndEnergyBoundingIsStill) {
  Pad none;
  Pad bounded;
  play(none, "press", "none");
  play(bounded, "press", "energy-bounding");
  const std::vector<RumbleLevels> cycle = none.between(2.0, 6.0);
  ASSERT_GE(cycle.size(), 190U);  // at 50 Hz
  ASSERT_LE(cycle.size(), 201U);
  RecordProperty("strong_from", weakest(cycle));
  RecordProperty("strong_to", strongest(cycle));
  EXPECT_GT(weakest(cycle), 0.6 * kFullLevel);
  EXPECT_LT(strongest(cycle), 1.05 * weakest(cycle));
  for (const RumbleLevels& levels : cycle) EXPECT_LT(levels.weak, 0.6 * levels.strong);
  EXPECT_LT(strongest(bounded.between(1.0, 6.0)), 0.01 * weakest(cycle));
}

TEST(RumblePump, ATapThumpsAtTheTouch) {
  Pad pad;
  const double touch_s = play(pad, "tap", "energy-bounding");
  ASSERT_GT(touch_s, 0.1);
  EXPECT_TRUE(pad.between(0.0, touch_s).empty());
  const std::vector<RumbleLevels> thump = pad.between(touch_s, touch_s + 0.04);
  ASSERT_FALSE(thump.empty());
  EXPECT_GT(thump.front().strong, 0.15 * kFullLevel);
  EXPECT_GT(thump.front().weak, 0.15 * kFullLevel) << "the click";
}

// A quarter of full scale; the vibration of a motor is the square of its level.
TEST(RumblePump, TheMotorsShareTheBand) {
  const auto last_at = [](double hz) {
    Pad pad;
    pad.swing(0, 1000, hz, 50.0 / (2.0 * std::numbers::pi * hz));
    return pad.calls.back().levels;
  };
  const RumbleLevels low = last_at(30.0);
  EXPECT_NEAR(std::pow(low.strong / kFullLevel, 2.0), 0.19, 0.03);
  EXPECT_EQ(low.weak, 0);
  const RumbleLevels high = last_at(250.0);
  EXPECT_NEAR(std::pow(high.weak / kFullLevel, 2.0), 0.11, 0.03);
  EXPECT_LT(high.strong, 0.75 * high.weak);
}

TEST(RumblePump, TheVolumeScalesTheVibrationOfBothMotors) {
  Pad loud;
  Pad quiet(0.25);
  loud.swing(0, 500, 80.0, 0.2);
  quiet.swing(0, 500, 80.0, 0.2);
  EXPECT_NEAR(quiet.calls.back().levels.strong, 0.5 * loud.calls.back().levels.strong, 1.0);
  EXPECT_NEAR(quiet.calls.back().levels.weak, 0.5 * loud.calls.back().levels.weak, 1.0);
}

// A handle beyond full scale stays within the range of 16 bits.
TEST(RumblePump, NeverExceedsTheRange) {
  Pad pad;
  pad.swing(0, 500, 50.0, 100.0);
  EXPECT_GT(pad.calls.back().levels.strong, 0.99 * kFullLevel);
}

TEST(RumblePump, StillnessIsToldOnce) {
  Pad pad;
  pad.swing(0, 500, 50.0, 0.2);
  EXPECT_TRUE(pad.felt->rumbles());
  pad.swing(500, 1500, 50.0, 0.0);
  EXPECT_FALSE(pad.felt->rumbles());
  const std::vector<RumbleLevels> after = pad.between(0.6, 1.5);
  EXPECT_TRUE(after.empty()) << after.size();
}

// The blind test: nothing of the wall is in the hand.
TEST(RumblePump, IsStillWhileItIsMasked) {
  Pad pad;
  pad.swing(0, 500, 50.0, 0.2);
  pad.mix.masked = true;
  pad.swing(500, 1500, 50.0, 0.2);
  EXPECT_FALSE(pad.felt->rumbles());
  EXPECT_TRUE(pad.between(0.52, 1.5).empty());
  pad.mix.masked = false;
  pad.swing(1500, 1600, 50.0, 0.2);
  EXPECT_TRUE(pad.felt->rumbles());
}

TEST(RumblePump, StopsTheMotorsAtItsEnd) {
  const auto felt = std::make_shared<Felt>();
  FakeGamepad gamepad(felt);
  {
    RumblePump pump({nullptr, 1000.0, true}, gamepad);
    std::array<Tick, 40> ticks;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      ticks[i].axes[0].tick = i;
      ticks[i].axes[0].truth.velocity_m_per_s = i % 20 < 10 ? 0.1 : -0.1;
    }
    EXPECT_FALSE(pump.step(ticks, {1.0, false}));
    EXPECT_TRUE(felt->rumbles());
  }
  EXPECT_FALSE(felt->rumbles());
}

}  // namespace
}  // namespace hapticwall::sound::test
