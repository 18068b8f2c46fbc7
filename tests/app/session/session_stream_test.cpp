// A stream beside a session: it never costs the recording a row. In virtual time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "tests/app/file/stream_support.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

using file::test::opened_stream;
using file::test::StreamReader;
using file::test::ticks_in;
using test::contact_scene;
using test::eventually;
using test::expect_without_gap;
using test::lines_of;
using test::TemporaryFolder;

constexpr std::uint32_t kStreamedTicks =
    20'000;  // fewer than the queue holds, more than pipe and buffer

class SessionStream : public ::testing::Test {
 protected:
  void start() {
    SessionOptions options;
    options.start_paused = true;
    options.clock = &clock_;
    // The loop's priority is above the recorder's: without a rest it may keep every core.
    clock_.after_sleep = [cycles = 0](test::FakeClock&) mutable {
      if (++cycles % 32 == 0) std::this_thread::sleep_for(std::chrono::microseconds(20));
    };
    options.stream = opened_stream(reader_.path());
    session_ = test::started(contact_scene(), options);
  }
  void step(
      std::uint32_t ticks, const std::function<void()>& meanwhile = [] {}) {
    const std::uint64_t end = session_->snapshot().timing.ticks + ticks;
    session_->step(ticks);
    ASSERT_TRUE(eventually([&] {
      meanwhile();
      return session_->snapshot().timing.ticks >= end;
    }));
  }
  // All rows, whatever `meanwhile` does with the reader.
  void expect_whole_recording(const std::function<void()>& meanwhile) {
    start();
    ASSERT_FALSE(session_->start_recording(folder_.file("a.csv")));
    step(kStreamedTicks, meanwhile);
    const Failure failure = session_->stop_recording();
    ASSERT_FALSE(failure) << failure->message;
    const auto lines = lines_of(folder_.file("a.csv"));
    ASSERT_EQ(lines.size(), kStreamedTicks + 1U);
    expect_without_gap(lines, 0);
    EXPECT_EQ(session_->recording_status().rows, kStreamedTicks);
    EXPECT_EQ(session_->recording_status().dropped_rows, 0U);
  }

  const TemporaryFolder folder_;
  StreamReader reader_{folder_.file("pipe")};
  test::FakeClock clock_;  // outlives the session
  std::unique_ptr<LiveSession> session_;
};

TEST_F(SessionStream, ARecordingIsWholeBesideAReaderThatNeverReads) {
  expect_whole_recording([] {});
  const auto ticks = ticks_in(reader_.objects());
  EXPECT_GT(ticks.size(), 0U);
  EXPECT_LT(ticks.size(), kStreamedTicks) << "the reader lost some";
}

TEST_F(SessionStream, ARecordingIsWholeBesideAReaderThatClosesEarly) {
  expect_whole_recording([&] {
    if (reader_.read_some()) reader_.close_early();
  });
}

TEST_F(SessionStream, ARecordingIsWholeBesideASlowReader) {
  expect_whole_recording([&] { reader_.read_some(); });
  session_.reset();
  const auto objects = reader_.objects();
  std::uint64_t first_missing = 0;
  for (const std::uint64_t tick : ticks_in(objects)) {
    ASSERT_GE(tick, first_missing) << "in order";
    first_missing = tick + 1;
  }
}

TEST_F(SessionStream, HasEveryTickWithoutARecording) {
  start();
  step(500);
  session_.reset();
  const auto objects = reader_.objects();
  const auto ticks = ticks_in(objects);
  ASSERT_EQ(ticks.size(), 500U);
  for (std::size_t i = 0; i < ticks.size(); ++i) ASSERT_EQ(ticks[i], i);
  EXPECT_EQ(objects.back(), nlohmann::json::parse(R"({"end":true,"samples":500,"lost":0})"));
}

TEST_F(SessionStream, ReachesTheReaderWhileItRuns) {
  EXPECT_LE(Recorder::kStreamInterval, std::chrono::milliseconds(20)) << "50 times a second";
  start();
  step(3);
  EXPECT_TRUE(eventually([&] { return ticks_in(reader_.objects()).size() == 3; }));
}

TEST_F(SessionStream, ARecordingInItsMiddleHasItsOwnTicksAlone) {
  start();
  for (const bool recorded : {false, true, false}) {
    if (recorded) {
      ASSERT_FALSE(session_->start_recording(folder_.file("a.csv")));
    }
    step(100);
    ASSERT_FALSE(session_->stop_recording());
  }
  const auto lines = lines_of(folder_.file("a.csv"));
  ASSERT_EQ(lines.size(), 101U);
  expect_without_gap(lines, 100);
  EXPECT_EQ(session_->recording_status().rows, 100U);
  session_.reset();
  const auto objects = reader_.objects();
  EXPECT_EQ(ticks_in(objects).size(), 300U);
  EXPECT_EQ(objects.back()["lost"], 0) << "a paused session loses nothing";
}

TEST_F(SessionStream, TellsMarksSwitchesAndEventsOfTheWindow) {
  start();
  step(10);
  ASSERT_FALSE(session_->start_recording(folder_.file("a.csv")));
  step(10);
  ASSERT_FALSE(session_->mark("a \"mark\""));
  AlgorithmSettings algorithm;
  algorithm.index = *find_algorithm("half-sample");
  ASSERT_FALSE(session_->set_algorithm(algorithm));
  step(10);
  static_cast<void>(session_->snapshot());
  session_->add_event("trial", ",\"trial\":3");
  step(10);
  session_.reset();
  std::vector<std::string> events;
  for (const auto& object : reader_.objects())
    if (object.contains("event")) events.push_back(object.dump());
  const double period_s = contact_scene().sampling.period_s();
  const auto event = [&](std::uint64_t tick, nlohmann::json more) {
    more["tick"] = tick;
    more["time_s"] = static_cast<double>(tick) * period_s;
    return more.dump();
  };
  EXPECT_THAT(events,
              ::testing::ElementsAre(event(19, {{"event", "mark"}, {"text", "a \"mark\""}}),
                                     event(20, {{"event", "algorithm"}, {"name", "half-sample"}}),
                                     event(29, {{"event", "trial"}, {"trial", 3}})));
}

TEST_F(SessionStream, GoesOnFromTickZeroAfterAReset) {
  start();
  step(2);
  session_->reset();
  step(2);
  session_.reset();
  EXPECT_EQ(ticks_in(reader_.objects()), (std::vector<std::uint64_t>{0, 1, 0, 1}));
}

}  // namespace
}  // namespace hapticwall::session
