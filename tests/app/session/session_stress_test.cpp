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

// Rounds of everything that an owner may do.
class BusyOwner {
 public:
  BusyOwner(LiveSession& session, const TemporaryFolder& folder)
      : session_(session), folder_(folder) {}

  void change_parameters() {
    AlgorithmSettings algorithm;
    algorithm.index = round_ % algorithms().size();
    ASSERT_FALSE(session_.set_algorithm(algorithm));
    auto walls = session_.scene().x().walls;
    walls[0].stiffness_n_per_m = 1000.0 * static_cast<double>(1 + round_ % 20);
    ASSERT_FALSE(session_.set_walls(walls));
    // Every other round leaves the loop some time to take what the owner changes next.
    for (std::uint64_t i = 0; i <= round_ % 2; ++i) {
      const Scene& plant = plants_[(round_ / 2 + i) % plants_.size()];
      Scene changed = session_.scene();
      changed.x().device = plant.x().device;
      changed.x().hand = plant.x().hand;
      changed.simulator = plant.simulator;
      ASSERT_FALSE(session_.change_scene(changed));
    }
  }

  void move_hand() {
    if (round_ % 3 == 0) {
      session_.move_hand(test::hand_to(0.04 + 1e-3 * static_cast<double>(round_ % 20)));
    } else {
      session_.move_hand({.m = {1e-3}, .duration_s = 0.01});
    }
  }

  void drive() {
    session_.pause(true);
    session_.step(3);
    session_.pause(false);
    const std::string name = folder_.file(std::to_string(round_ % 4) + ".csv");
    Failure failure;
    if (round_ % 50 == 10) failure = session_.start_recording(name);
    if (round_ % 50 == 40) failure = session_.stop_recording();
    ASSERT_FALSE(failure) << failure->message;
    if (round_ % 200 == 30) session_.reset();
    static_cast<void>(session_.recording_status());
  }

  void watch() {
    session_.read_timing(histograms_);
    went_back_ += histograms_.wake_latency.total() < cycles_ ? 1U : 0U;
    cycles_ = histograms_.wake_latency.total();
    const std::size_t count = session_.take_ticks(ticks_);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t tick = ticks_[i].x().tick;
      out_of_order_ += tick == previous_ + 1 || tick == 0 || taken_ + i == 0 ? 0U : 1U;
      previous_ = tick;
    }
    taken_ += count;
  }

  void begin_round() { ++round_; }
  [[nodiscard]] std::uint64_t rounds() const { return round_; }
  void expect_order() const {
    EXPECT_EQ(out_of_order_, 0U);
    EXPECT_GT(taken_, 0U);
    EXPECT_EQ(went_back_, 0U);
  }

 private:
  LiveSession& session_;
  const TemporaryFolder& folder_;  // outlives the session, which records into it
  const std::vector<Scene> plants_ = plant_changes(contact_scene());
  std::uint64_t round_ = 0;
  std::array<Tick, 256> ticks_{};
  std::uint64_t out_of_order_ = 0;
  std::uint64_t taken_ = 0;
  std::uint64_t previous_ = 0;
  TimingHistograms histograms_;
  std::uint64_t cycles_ = 0;
  std::uint64_t went_back_ = 0;
};

TEST(SessionStress, TheOwnerDoesEverythingAtOnce) {
  const TemporaryFolder folder;
  auto started = LiveSession::start(contact_scene(10000.0));
  ASSERT_TRUE(started) << started.error().message;
  LiveSession& session = **started;
  BusyOwner owner(session, folder);
  // Enough rounds to have recorded, also where the loop takes most of the machine.
  while (session.snapshot().timing.ticks < kStressTicks || owner.rounds() <= kMinRounds) {
    owner.begin_round();
    ASSERT_NO_FATAL_FAILURE(owner.change_parameters());
    owner.move_hand();
    ASSERT_NO_FATAL_FAILURE(owner.drive());
    owner.watch();
    std::this_thread::yield();
  }
  owner.expect_order();
  EXPECT_EQ(session.dropped_plot_samples(), 0U);
  EXPECT_FALSE(session.snapshot().ended_by_fault);
}

}  // namespace
}  // namespace hapticwall::session
