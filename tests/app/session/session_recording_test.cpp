// Recordings of live sessions: complete, numbered without a gap, and repeatable where they say so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "app/session/live_session.h"
#include "tests/app/session/loop/fake_writer.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

using test::algorithm;
using test::contact_scene;
using test::eventually;
using test::expect_repeated;
using test::expect_without_gap;
using test::FakeWriter;
using test::flags_of;
using test::generation_is;
using test::lines_of;
using test::loop_session;
using test::moving_scene;
using test::plant_changes;
using test::rows_reach;
using test::started;
using test::started_paused;
using test::TemporaryFolder;
using test::text_of;
using test::tick_of;
using test::ticks_reach;
using test::with_algorithm;
using test::WriterLog;
using ::testing::HasSubstr;

TEST(SessionRecording, EveryAlgorithmInTurnIsCompleteAndRepeatsBitForBit) {
  const TemporaryFolder folder;
  const auto session = started_paused(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  session->pause(false);
  constexpr std::uint64_t kTicks = 500;
  const std::uint64_t leg = kTicks / (algorithms().size() + 1);
  for (std::size_t index = 0; index < algorithms().size(); ++index) {
    ASSERT_TRUE(ticks_reach(*session, leg * (index + 1)));
    ASSERT_FALSE(session->set_algorithm(algorithm(index)));
    ASSERT_TRUE(generation_is(*session, index + 2));
  }
  ASSERT_TRUE(ticks_reach(*session, kTicks));
  EXPECT_EQ(session->recording_status().state, RecordingState::kRecording);
  const Failure failure = session->stop_recording();
  ASSERT_FALSE(failure) << failure->message;
  const RecordingStatus status = session->recording_status();
  EXPECT_EQ(status.state, RecordingState::kIdle);
  EXPECT_EQ(status.dropped_rows, 0U);
  EXPECT_EQ(status.path, folder.file("a.csv"));

  const auto lines = lines_of(folder.file("a.csv"));
  ASSERT_GE(lines.size(), kTicks + 1);
  EXPECT_EQ(lines.size(), status.rows + 1);
  expect_without_gap(lines, 0);

  // The sidecar's changes are at the ticks which the rows flag.
  const auto loaded = file::load_scene(folder.file("a.toml"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  std::vector<std::uint64_t> flagged;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (flags_of(lines[0], lines[i]) & kFlagParametersChanged) flagged.push_back(tick_of(lines[i]));
  }
  ASSERT_EQ(loaded->changes.size(), algorithms().size());
  ASSERT_EQ(flagged.size(), algorithms().size());
  for (std::size_t i = 0; i < flagged.size(); ++i) {
    EXPECT_EQ(loaded->changes[i].tick, flagged[i]);
    EXPECT_EQ(loaded->changes[i].scene.algorithm.index, i);
  }

  expect_repeated(lines, folder.file("a.toml"));
}

// Mass, damping, friction, hand, grip, encoder, limit, resolution, delay, lag, integrator,
// substeps: all changed while it moves and is recorded, and as often as not several times between
// two ticks.
TEST(SessionRecording, EveryPartOfThePlantChangedInMotionRepeatsBitForBit) {
  const TemporaryFolder folder;
  const auto session = started_paused(moving_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  session->pause(false);
  const std::vector<Scene> changes = plant_changes(moving_scene());
  constexpr std::uint64_t kLeg = 40;
  std::uint32_t generation = 1;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    ASSERT_TRUE(ticks_reach(*session, kLeg * (i + 1)));
    ASSERT_FALSE(session->change_scene(changes[i]));
    ++generation;
    if (i % 3 == 2) {  // there and back; the loop may see any of it
      ASSERT_FALSE(session->change_scene(changes[i - 1]));
      ASSERT_FALSE(session->change_scene(changes[i]));
      generation += 2;
    }
    ASSERT_TRUE(generation_is(*session, generation));
  }
  ASSERT_TRUE(ticks_reach(*session, kLeg * (changes.size() + 5)));
  ASSERT_FALSE(session->stop_recording());

  const auto lines = lines_of(folder.file("a.csv"));
  expect_without_gap(lines, 0);
  const auto loaded = file::load_scene(folder.file("a.toml"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_GE(loaded->changes.size(), changes.size());
  EXPECT_EQ(loaded->changes.back().scene.x().hand, changes.back().x().hand);
  EXPECT_EQ(loaded->changes.back().scene.x().device, changes.back().x().device);
  EXPECT_EQ(loaded->scene.x().device, moving_scene().x().device) << "as it was at the start";
  EXPECT_THAT(text_of(folder.file("a.toml")), HasSubstr("repeatable = true"));
  expect_repeated(lines, folder.file("a.toml"));
}

TEST(SessionRecording, BegunLaterItStillTellsTheChangesSinceTickZero) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  ASSERT_TRUE(ticks_reach(*session, 30));
  auto walls = session->scene().x().walls;
  walls[0].stiffness_n_per_m = 2000.0;
  ASSERT_FALSE(session->set_walls(walls));
  ASSERT_TRUE(generation_is(*session, 2));
  ASSERT_TRUE(ticks_reach(*session, 100));
  ASSERT_FALSE(session->start_recording(folder.file("late.csv")));
  ASSERT_TRUE(rows_reach(*session, 50));
  ASSERT_FALSE(session->stop_recording());

  const auto lines = lines_of(folder.file("late.csv"));
  const std::uint64_t first_tick = tick_of(lines.at(1));
  EXPECT_GE(first_tick, 100U);
  expect_without_gap(lines, first_tick);
  const auto loaded = file::load_scene(folder.file("late.toml"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->first_recorded_tick, first_tick);
  ASSERT_EQ(loaded->changes.size(), 1U);
  EXPECT_LT(loaded->changes[0].tick, first_tick);
  EXPECT_EQ(loaded->changes[0].scene.x().walls[0].stiffness_n_per_m, 2000.0);
  expect_repeated(lines, folder.file("late.toml"));
}

TEST(SessionRecording, ResetFinishesItAndTheNextOneStartsWithTheNewTickZero) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("one.csv")));
  ASSERT_TRUE(rows_reach(*session, 50));
  Scene changed = with_algorithm(session->scene(), 0);
  changed.x().device.mass_kg = 0.2;
  ASSERT_FALSE(session->change_scene(changed));
  ASSERT_TRUE(generation_is(*session, 2));
  session->reset();
  EXPECT_EQ(session->recording_status().state, RecordingState::kIdle);
  const auto one = lines_of(folder.file("one.csv"));
  ASSERT_GT(one.size(), 50U);
  expect_without_gap(one, tick_of(one[1]));

  ASSERT_FALSE(session->start_recording(folder.file("two.csv")));
  ASSERT_TRUE(rows_reach(*session, 50));
  ASSERT_FALSE(session->stop_recording());
  const auto two = lines_of(folder.file("two.csv"));
  EXPECT_EQ(session->snapshot().resets, 1U);
  expect_without_gap(two, tick_of(two.at(1)));
  const auto loaded = file::load_scene(folder.file("two.toml"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->changes.empty());
  EXPECT_EQ(loaded->scene.algorithm.index, 0U) << "as it was at the new tick 0";
  EXPECT_EQ(loaded->scene.x().device.mass_kg, 0.2) << "as it was at the new tick 0";
}

TEST(SessionRecording, ARecordingThatThePointerLedIsNotRepeatable) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  const auto record = [&](const std::string& name) {
    ASSERT_FALSE(session->start_recording(folder.file(name + ".csv")));
    ASSERT_TRUE(rows_reach(*session, 20));
    ASSERT_FALSE(session->stop_recording());
  };
  record("script");
  EXPECT_THAT(text_of(folder.file("script.toml")), HasSubstr("repeatable = true"));
  session->move_hand(test::hand_to(0.04));
  ASSERT_TRUE(eventually([&] { return session->snapshot().newest.x().truth.hand_path_m < 0.041; }));
  record("after");
  EXPECT_THAT(text_of(folder.file("after.toml")), HasSubstr("repeatable = false"));
  EXPECT_THAT(text_of(folder.file("after.toml")), HasSubstr("pointer"));
  session->reset();
  record("again");
  EXPECT_THAT(text_of(folder.file("again.toml")), HasSubstr("repeatable = true"));
}

TEST(SessionRecording, RefusesWhatCannotBeAndSaysWhy) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  EXPECT_FALSE(session->stop_recording()) << "nothing to stop is no failure";
  const Failure unwritable = session->start_recording(folder.file("missing/a.csv"));
  ASSERT_TRUE(unwritable);
  EXPECT_EQ(unwritable->kind, ErrorKind::kFile);
  EXPECT_EQ(session->recording_status().state, RecordingState::kIdle);
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  const Failure twice = session->start_recording(folder.file("b.csv"));
  ASSERT_TRUE(twice);
  EXPECT_THAT(twice->message, HasSubstr("a.csv"));
  EXPECT_FALSE(session->stop_recording());
}

// A row that the loop had still to push would be lost, or turn up in the next file.
TEST(SessionRecording, StopWaitsForTheLoopsWord) {
  constexpr double kSlowRateHz = 100.0;
  const auto session = loop_session(kSlowRateHz);
  ASSERT_TRUE(ticks_reach(*session, 1));
  for (int i = 0; i < 5; ++i) {
    const std::uint64_t ticks = session->snapshot().timing.ticks;
    // Two answers of the loop lie at least one cycle apart.
    for (int answer = 0; answer < 2; ++answer) {
      session->record_into(std::make_unique<FakeWriter>(std::make_shared<WriterLog>()));
      ASSERT_FALSE(session->stop_recording());
    }
    EXPECT_GT(session->snapshot().timing.ticks, ticks);
  }
}

}  // namespace
}  // namespace hapticwall::session
