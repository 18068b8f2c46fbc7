// Pointer events through the moves of the hand to the loop's ticks, on a clock of the test.
#include "app/ui/state/hand_lead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "tests/app/session/loop/servo_loop_support.h"

namespace hapticwall::ui {
namespace {

using session::test::Harness;

constexpr double kTickS = 1e-3;

// Frames at the given times hand their events over; the loop ticks in between.
struct LedRun {
  LedRun() : harness(session::test::contact_scene()) {
    harness.cycles(100);  // the script is over
    static_cast<void>(harness.samples());
  }

  void frame(double now_s) {
    while (next < events.size() && events[next].time_s <= now_s) lead.follow(events[next++]);
    for (const session::HandMove& move : lead.take(now_s))
      EXPECT_TRUE(harness.exchange.hand_moves.try_push(move));
  }
  // Frames at `frames_s`, in order; then the hand gets two seconds to arrive.
  void run(const std::vector<double>& frames_s) {
    lead.grab(events.front());
    next = 1;
    for (const double frame_s : frames_s) {
      tick_until(frame_s);
      frame(frame_s);
    }
    tick_until(frames_s.back() + 2.0);
    for (const Sample& sample : harness.samples()) path_m.push_back(sample.truth.hand_path_m);
  }
  void tick_until(double end_s) {
    for (; static_cast<double>(ticks) * kTickS < end_s; ++ticks) harness.cycles(1);
  }
  // Speeds in the ticks from the first to the last motion.
  [[nodiscard]] std::vector<double> speeds_m_per_s() const {
    std::vector<double> speeds;
    for (std::size_t i = 1; i < path_m.size(); ++i)
      speeds.push_back((path_m[i] - path_m[i - 1]) / kTickS);
    const auto moves = [](double speed) { return std::abs(speed) > 1e-9; };
    const auto first = std::ranges::find_if(speeds, moves);
    const auto last = std::find_if(speeds.rbegin(), speeds.rend(), moves).base();
    return {first, std::max(first, last)};
  }

  Harness harness;
  HandLead lead;
  std::vector<HandLead::Point> events;
  std::size_t next = 0;
  std::int64_t ticks = 0;
  std::vector<double> path_m;
};

// 90 px in 3.5 s, an event for each; 1 px is 0.8 mm.
constexpr double kPixelM = 0.8e-3;
constexpr int kPixels = 90;
constexpr double kDragS = 3.5;

class SteadyDrag : public ::testing::TestWithParam<double> {};

TEST_P(SteadyDrag, IsASteadyMotionOfTheHand) {
  LedRun run;
  for (int i = 0; i <= kPixels; ++i)
    run.events.push_back({kDragS * i / kPixels, {0.01 + kPixelM * i, 0.0}});
  std::vector<double> frames_s;
  for (int i = 1; frames_s.empty() || frames_s.back() < kDragS; ++i)
    frames_s.push_back(i / GetParam());
  run.run(frames_s);
  const double wanted_m_per_s = kPixels * kPixelM / kDragS;
  std::vector<double> speeds = run.speeds_m_per_s();
  ASSERT_GT(speeds.size(), 3400U);
  // The first and the last tick may begin or end within a line.
  speeds = {speeds.begin() + 1, speeds.end() - 1};
  double worst = 0.0;
  for (const double speed : speeds) worst = std::max(worst, std::abs(speed / wanted_m_per_s - 1.0));
  RecordProperty("worst_deviation_ppm", static_cast<int>(1e6 * worst));
  EXPECT_LT(worst, 0.02);
  EXPECT_NEAR(run.path_m.back() - run.path_m.front(), kPixels * kPixelM, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(FramesASecond, SteadyDrag, ::testing::Values(10.0, 24.0, 60.0, 144.0));

// A frame that comes late makes the hand wait, and no faster afterwards.
TEST(HandLead, ALateFrameMakesTheHandWaitAndNeverHurry) {
  LedRun run;
  for (int i = 0; i <= 200; ++i) run.events.push_back({0.01 * i, {1e-3 * i, 0.0}});
  std::vector<double> frames_s;
  for (double now_s = 0.0; now_s<2.1; now_s += now_s> 0.9 && now_s < 1.0 ? 0.4 : 1.0 / 60.0)
    frames_s.push_back(now_s);
  run.run(frames_s);
  for (const double speed : run.speeds_m_per_s()) ASSERT_LE(speed, 0.1 * (1.0 + 1e-9));
  EXPECT_NEAR(run.path_m.back() - run.path_m.front(), 0.2, 1e-9);
}

// The window system hands over what came while a frame was drawn, all at once.
TEST(HandLead, ABurstOfEventsIsOnePlace) {
  LedRun run;
  run.events = {{0.0, {}}};
  std::vector<double> frames_s;
  for (int frame = 1; frame <= 20; ++frame) {
    frames_s.push_back(0.1 * frame);
    for (int i = 1; i <= 6; ++i)
      run.events.push_back({0.1 * frame - 1e-4 + 1e-5 * i, {1e-3 * (6 * (frame - 1) + i), 0.0}});
  }
  run.run(frames_s);
  const std::vector<double> speeds = run.speeds_m_per_s();
  EXPECT_NEAR(*std::ranges::max_element(speeds), 0.06, 0.06 * 0.02);
  EXPECT_NEAR(run.path_m.back() - run.path_m.front(), 0.12, 1e-9);
}

TEST(HandLead, AfterARestTheHandIsNoLaterThanBefore) {
  LedRun run;
  run.events = {{0.0, {}}, {0.02, {1e-3, 0.0}}, {5.0, {2e-3, 0.0}}};
  std::vector<double> frames_s;
  for (int i = 1; i <= 320; ++i) frames_s.push_back(i / 60.0);
  run.run(frames_s);
  const std::size_t tick = 5250;
  EXPECT_NEAR(run.path_m[tick] - run.path_m[0], 2e-3, 1e-9);
}

// Promises for any pointer: the end is exact, and the hand is never faster than the pointer was or
// than an arm. Frames are late, dropped and early; events share times.
TEST(HandLead, NoSpeedAppearsThatThePointerDidNotHave) {
  std::mt19937_64 random(20261123);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int round = 0; round < 150; ++round) {
    LedRun run;
    run.events = {{0.0, {}}};
    std::vector<double> frames_s;
    double fastest_m_per_s = 0.0;
    const double most_m_per_s = std::pow(10.0, between(-2.0, 0.3));
    for (int i = 0; i < 60; ++i) {
      const HandLead::Point before = run.events.back();
      const double gap_s = between(0.0, 1.0) < 0.1 ? 0.0 : between(kBurstS, kRestS);
      const double speed = gap_s > 0.0 ? between(-most_m_per_s, most_m_per_s) : 0.0;
      // Two events of one time: the later one counts, and the way begins at the one before.
      const double way_m = speed * gap_s;
      run.events.push_back({before.time_s + gap_s, {before.place_m.x + way_m, 0.0}});
      fastest_m_per_s = std::max(fastest_m_per_s, std::abs(speed));
    }
    for (double now_s = 0.0; now_s < run.events.back().time_s;)
      frames_s.push_back(now_s +=
                         between(0.0, 1.0) < 0.1 ? between(0.1, 0.6) : between(0.001, 0.04));
    run.run(frames_s);
    const double limit = std::min(fastest_m_per_s, kMaxPointerSpeedMPerS) * (1.0 + 1e-9) + 1e-9;
    for (const double speed : run.speeds_m_per_s()) ASSERT_LE(std::abs(speed), limit) << round;
    if (fastest_m_per_s > kMaxPointerSpeedMPerS) continue;
    ASSERT_NEAR(run.path_m.back() - run.path_m.front(), run.events.back().place_m.x, 1e-9);
  }
}

}  // namespace
}  // namespace hapticwall::ui
