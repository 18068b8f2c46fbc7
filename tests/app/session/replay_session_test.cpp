// A recording that plays, by a clock that stands until it is told to go on.
#include "app/session/replay_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <limits>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/session/replay_support.h"

namespace hapticwall::session::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class HandMovedClock : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() override { return now_ns_; }
  void sleep_until_ns(std::int64_t deadline_ns) override { now_ns_ = deadline_ns; }
  void pass_ms(std::int64_t milliseconds) { now_ns_ += milliseconds * 1'000'000; }

 private:
  std::int64_t now_ns_ = 123;
};

class Replay : public ReplayTest {
 protected:
  // Three seconds at 1 kHz; the wall moves at tick 2000.
  void SetUp() override {
    ReplayTest::SetUp();
    const Scene scene = file::load_scene("press")->scene;
    ScheduledChange change{2000, scene};
    change.scene.x().walls.front().position_m = 0.045;
    record(scene, 3000, {}, {change});
  }
  ReplaySession& play(const ReplayOptions& options = {}, const std::string& name = "a.csv") {
    auto clock = std::make_unique<HandMovedClock>();
    clock_ = clock.get();
    session_ = std::make_unique<ReplaySession>(opened(path(name)), std::move(clock), options);
    return *session_;
  }
  std::vector<std::uint64_t> ticks_taken(std::size_t at_once = 64) {
    std::vector<std::uint64_t> ticks;
    std::vector<Tick> some(at_once);
    while (const std::size_t count = session_->take_ticks(some)) {
      for (std::size_t i = 0; i < count; ++i) ticks.push_back(some[i].x().tick);
    }
    return ticks;
  }
  static void expect_consecutive(const std::vector<std::uint64_t>& ticks, std::uint64_t first,
                                 std::uint64_t last) {
    ASSERT_THAT(ticks, SizeIs(last - first + 1));
    for (std::size_t i = 0; i < ticks.size(); ++i) ASSERT_EQ(ticks[i], first + i);
  }

  HandMovedClock* clock_ = nullptr;
  std::unique_ptr<ReplaySession> session_;
};

TEST_F(Replay, PlaysARowAMillisecondAndNoneIsLost) {
  ReplaySession& session = play();
  EXPECT_EQ(session.begin_s(), 0.0);
  EXPECT_EQ(session.end_s(), 2.999);
  expect_consecutive(ticks_taken(), 0, 0);
  clock_->pass_ms(500);
  expect_consecutive(ticks_taken(), 1, 500);
  EXPECT_EQ(session.position_s(), 0.5);
  EXPECT_EQ(session.snapshot().newest.x().tick, 500U);
  EXPECT_EQ(session.snapshot().timing.ticks, 501U);
  clock_->pass_ms(60'000);
  expect_consecutive(ticks_taken(3), 501, 2999);
}

TEST_F(Replay, ShowsTheRowsAsTheyWereRecorded) {
  ReplaySession& session = play();
  clock_->pass_ms(1234);
  const Sample shown = session.snapshot().newest.x();
  Tick row;
  ASSERT_EQ(*session.read(1234, {&row, 1}), 1U);
  const Sample& recorded = row.x();
  EXPECT_EQ(shown.tick, 1234U);
  EXPECT_EQ(shown.force_n, recorded.force_n);
  EXPECT_EQ(shown.truth.hand_path_m, recorded.truth.hand_path_m);
}

TEST_F(Replay, EndsPausedAndBeginsAnewWhenItGoesOn) {
  ReplaySession& session = play();
  EXPECT_FALSE(session.snapshot().paused);
  clock_->pass_ms(10'000);
  EXPECT_TRUE(session.at_end());
  EXPECT_TRUE(session.snapshot().paused);
  static_cast<void>(ticks_taken());
  session.pause(false);
  EXPECT_EQ(session.snapshot().resets, 1U);
  clock_->pass_ms(10);
  expect_consecutive(ticks_taken(), 0, 10);
}

TEST_F(Replay, LoopsWithoutLosingARow) {
  ReplayOptions options;
  options.loop = true;
  options.speed = 100.0;
  ReplaySession& session = play(options);
  std::uint64_t next = 0;
  for (int frame = 0; frame < 20; ++frame) {
    clock_->pass_ms(16);
    for (const std::uint64_t tick : ticks_taken()) {
      ASSERT_EQ(tick, next);
      next = (next + 1) % 3000;
    }
  }
  EXPECT_GT(session.snapshot().resets, 3U);
  EXPECT_FALSE(session.snapshot().paused);
}

TEST_F(Replay, AnySpeedBetweenAHundredthAndAHundred) {
  ReplaySession& session = play();
  session.set_speed(0.01);
  clock_->pass_ms(1000);
  expect_consecutive(ticks_taken(), 0, 10);
  session.set_speed(2.5);
  clock_->pass_ms(100);
  expect_consecutive(ticks_taken(), 11, 260);
  session.set_speed(0.0);
  EXPECT_EQ(session.speed(), kMinReplaySpeed);
  session.set_speed(1e9);
  EXPECT_EQ(session.speed(), kMaxReplaySpeed);
  session.set_speed(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(session.speed(), kMaxReplaySpeed);
  clock_->pass_ms(20);
  expect_consecutive(ticks_taken(), 261, 2260);
}

TEST_F(Replay, AChangeOfSpeedDoesNotMoveThePlace) {
  ReplaySession& session = play();
  clock_->pass_ms(700);
  session.set_speed(100.0);
  EXPECT_NEAR(session.position_s(), 0.7, 1e-12);
}

TEST_F(Replay, PausesAndSteps) {
  ReplayOptions options;
  options.start_paused = true;
  ReplaySession& session = play(options);
  clock_->pass_ms(500);
  expect_consecutive(ticks_taken(), 0, 0);
  session.step(5);
  expect_consecutive(ticks_taken(), 1, 5);
  session.step(1'000'000);
  EXPECT_EQ(session.snapshot().newest.x().tick, 2999U);
  session.reset();
  EXPECT_TRUE(session.snapshot().paused);
  session.pause(false);
  session.step(100);  // only while paused
  expect_consecutive(ticks_taken(), 0, 0);
}

TEST_F(Replay, SeeksAndShowsWhatWasBefore) {
  ReplayOptions options;
  options.history_s = 0.5;
  options.start_paused = true;
  ReplaySession& session = play(options);
  session.seek(2.0);
  EXPECT_EQ(session.snapshot().resets, 1U);
  EXPECT_EQ(session.position_s(), 2.0);
  expect_consecutive(ticks_taken(), 1500, 2000);
  session.seek(0.1);
  expect_consecutive(ticks_taken(), 0, 100);
  session.seek(1e300);
  EXPECT_EQ(session.snapshot().newest.x().tick, 2999U);
  session.seek(-5.0);
  EXPECT_EQ(session.snapshot().newest.x().tick, 0U);
  session.seek(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(session.snapshot().resets, 4U);
  expect_consecutive(ticks_taken(), 0, 0);
  session.seek(1.0);
  session.pause(false);
  clock_->pass_ms(10);
  expect_consecutive(ticks_taken(), 500, 1010);
}

TEST_F(Replay, TheSceneIsThatOfThePlace) {
  ReplaySession& session = play();
  EXPECT_EQ(session.scene().x().walls.front().position_m, 0.05);
  session.seek(2.0);
  EXPECT_EQ(session.scene().x().walls.front().position_m, 0.045);
  EXPECT_EQ(session.snapshot().generation, 1U);
  session.seek(1.999);
  EXPECT_EQ(session.scene().x().walls.front().position_m, 0.05);
}

TEST_F(Replay, NamesItsFileAndHasNoLoop) {
  ReplaySession& session = play();
  EXPECT_EQ(session.snapshot().arming.state, ArmingState::kNotNeeded);
  EXPECT_TRUE(session.knows_truth());
  EXPECT_EQ(session.device_info().name, "recording a.csv");
  EXPECT_THAT(session.realtime_status().text, HasSubstr("a recording"));
  EXPECT_THAT(session.device_trouble(), IsEmpty());
}

TEST_F(Replay, AFileThatIsNoLongerThereEndsIt) {
  ReplaySession& session = play();
  std::filesystem::resize_file(path("a.csv"), 1000);
  clock_->pass_ms(2500);
  EXPECT_TRUE(session.snapshot().ended_by_fault);
  EXPECT_THAT(session.device_trouble(), HasSubstr("changed while it was read"));
  std::array<Tick, 10> some;
  EXPECT_EQ(session.take_ticks(some), 0U);
  session.pause(false);
  session.seek(0.0);
  EXPECT_TRUE(session.snapshot().paused);
}

TEST_F(Replay, ARecordingThatBeganLaterBeginsThere) {
  record(file::load_scene("press")->scene, 3000, {}, {}, 1000);
  ReplaySession& session = play();
  EXPECT_EQ(session.begin_s(), 1.0);
  EXPECT_EQ(session.position_s(), 1.0);
  clock_->pass_ms(2);
  expect_consecutive(ticks_taken(), 1000, 1002);
  session.seek(0.0);
  EXPECT_EQ(session.snapshot().newest.x().tick, 1000U);
}

TEST_F(Replay, AnOverlayIsFoundByItsTicks) {
  ReplaySession& session = play();
  EXPECT_EQ(session.overlay(), nullptr);
  Overlay overlay{"none", std::vector<Sample>(3)};
  for (std::size_t i = 0; i < 3; ++i) overlay.samples[i].tick = 10 + i;
  session.lay_over(overlay);
  ASSERT_NE(session.overlay(), nullptr);
  EXPECT_EQ(session.overlay()->at(9), nullptr);
  EXPECT_EQ(session.overlay()->at(12)->tick, 12U);
  EXPECT_EQ(session.overlay()->at(13), nullptr);
  EXPECT_EQ(Overlay{}.at(0), nullptr);
  session.lay_over(std::nullopt);
  EXPECT_EQ(session.overlay(), nullptr);
}

TEST_F(Replay, StartsByTheRealClock) {
  const auto session = start_replay(path("a.csv"));
  ASSERT_TRUE(session);
  EXPECT_EQ((*session)->recording().scanned.rows, 3000U);
  const auto missing = start_replay(path("b.csv"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace hapticwall::session::test
