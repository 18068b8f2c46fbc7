#include "app/session/loop/sound_feed.h"

#include <gtest/gtest.h>

#include "device/simulated_device.h"
#include "tests/app/session/loop/loop_bench.h"
#include "tests/app/session/support.h"

namespace hapticwall::session {
namespace {

using Bench = test::LoopBench<device::SimulatedDevice>;

TEST(SoundFeed, GetsTicksOnlyWhenItWantsThem) {
  const Scene scene = test::contact_scene();
  Bench bench(scene, false, {}, scene);
  bench.cycles(10);
  EXPECT_EQ(bench.exchange.sound->ticks.size(), 0U);
  bench.exchange.sound->wanted = true;
  bench.cycles(10);
  Tick tick;
  for (std::uint64_t i = 10; i < 20; ++i) {
    ASSERT_TRUE(bench.exchange.sound->ticks.try_pop(tick));
    EXPECT_EQ(tick.x().tick, i);
  }
  EXPECT_FALSE(bench.exchange.sound->ticks.try_pop(tick));
}

// A sound that is stuck costs plots and rows nothing.
TEST(SoundFeed, AFullFeedIsLostToTheSoundAlone) {
  const Scene scene = test::contact_scene();
  Bench bench(scene, false, {.plot = 1000, .recorder = 1000, .sound = 4}, scene);
  bench.exchange.sound->wanted = true;
  bench.command(CommandKind::kStartRecording);
  bench.cycles(500);
  EXPECT_EQ(bench.exchange.sound->ticks.size(), 4U);
  EXPECT_EQ(bench.exchange.plot.size(), 500U);
  EXPECT_EQ(bench.exchange.recorder.size(), 500U);
  EXPECT_EQ(bench.exchange.dropped_plot_samples, 0U);
  EXPECT_EQ(bench.exchange.dropped_rows, 0U);
}

}  // namespace
}  // namespace hapticwall::session
