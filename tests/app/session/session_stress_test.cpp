// An owner that does everything at once to a loop at 10 kHz; clean under ThreadSanitizer.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/session/live_session.h"
#include "tests/app/session/support.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;
using test::plant_changes;
using test::TemporaryFolder;

constexpr std::uint64_t kStressTicks = 6000;
constexpr std::uint64_t kMinRounds = 50;

TEST(SessionStress, TheOwnerDoesEverythingAtOnce) {
  const TemporaryFolder folder;
  auto started = LiveSession::start(contact_scene(10000.0));
  ASSERT_TRUE(started) << started.error().message;
  LiveSession& session = **started;
  const std::vector<Scene> plants = plant_changes(contact_scene());
  std::array<Tick, 256> ticks;
  std::uint64_t round = 0;
  std::uint64_t out_of_order = 0;
  std::uint64_t taken = 0;
  TimingHistograms histograms;
  std::uint64_t cycles = 0;
  std::uint64_t went_back = 0;
  std::uint64_t previous = 0;
  // Enough rounds to have recorded, also where the loop takes most of the machine.
  while (session.snapshot().timing.ticks < kStressTicks || round <= kMinRounds) {
    ++round;
    AlgorithmSettings algorithm;
    algorithm.index = round % algorithms().size();
    ASSERT_FALSE(session.set_algorithm(algorithm));
    auto walls = session.scene().x().walls;
    walls[0].stiffness_n_per_m = 1000.0 * static_cast<double>(1 + round % 20);
    ASSERT_FALSE(session.set_walls(walls));
    // Every other round leaves the loop some time to take what the owner changes next.
    for (std::uint64_t i = 0; i <= round % 2; ++i) {
      const Scene& plant = plants[(round / 2 + i) % plants.size()];
      Scene changed = session.scene();
      changed.x().device = plant.x().device;
      changed.x().hand = plant.x().hand;
      changed.simulator = plant.simulator;
      ASSERT_FALSE(session.change_scene(changed));
    }
    if (round % 3 == 0) {
      session.move_hand(test::hand_to(0.04 + 1e-3 * static_cast<double>(round % 20)));
    } else {
      session.move_hand({.m = {1e-3}, .duration_s = 0.01});
    }
    session.pause(true);
    session.step(3);
    session.pause(false);
    const std::string name = folder.file(std::to_string(round % 4) + ".csv");
    Failure failure;
    if (round % 50 == 10) failure = session.start_recording(name);
    if (round % 50 == 40) failure = session.stop_recording();
    ASSERT_FALSE(failure) << failure->message;
    if (round % 200 == 30) session.reset();
    static_cast<void>(session.recording_status());
    session.read_timing(histograms);
    went_back += histograms.wake_latency.total() < cycles ? 1U : 0U;
    cycles = histograms.wake_latency.total();
    const std::size_t count = session.take_ticks(ticks);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t tick = ticks[i].x().tick;
      out_of_order += tick == previous + 1 || tick == 0 || taken + i == 0 ? 0U : 1U;
      previous = tick;
    }
    taken += count;
    std::this_thread::yield();
  }
  EXPECT_EQ(out_of_order, 0U);
  EXPECT_GT(taken, 0U);
  EXPECT_EQ(went_back, 0U);
  EXPECT_EQ(session.dropped_plot_samples(), 0U);
  EXPECT_FALSE(session.snapshot().ended_by_fault);
}

}  // namespace
}  // namespace hapticwall::session
