// A live session of two axes: the rows of a headless run, replayed and repeated.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "app/file/recording_reader.h"
#include "app/runtime/replay_session.h"
#include "app/runtime/scene_change.h"
#include "app/runtime/session.h"
#include "tests/app/runtime_session_support.h"

namespace hapticwall::runtime {
namespace {

using test::contact_scene;
using test::started_paused;
using test::TemporaryFolder;
using test::text_of;
using test::ticks_reach;

constexpr std::uint64_t kCornerTicks = 600;

Scene corner_scene() {
  Scene scene = contact_scene();
  scene.y.emplace();
  scene.y->device = scene.device;
  scene.y->device.mass_kg *= 2.0;
  scene.y->hand = scene.hand;
  scene.y->walls = scene.walls;
  scene.y->walls[0].stiffness_n_per_m *= 0.5;
  return scene;
}

std::string headless_csv(const file::LoadedScene& loaded) {
  const auto columns = file::more_columns(true, true);
  std::string text = file::csv_header(columns) + "\n";
  AxesOptions options;
  options.changes = loaded.changes;
  options.on_samples = [&](const Sample& x, const Sample& y) {
    file::append_csv_row(text, x, columns, y);
  };
  static_cast<void>(simulate_axes(loaded.scene, options));
  return text;
}

// Records kCornerTicks ticks; `change`, if any, comes half way.
void record(const std::string& csv, const std::optional<Scene>& change) {
  const auto session = started_paused(corner_scene());
  ASSERT_FALSE(session->start_recording(csv));
  session->step(kCornerTicks / 2);
  ASSERT_TRUE(ticks_reach(*session, kCornerTicks / 2));
  if (change) {
    const auto problem = session->change_scene(*change);
    ASSERT_FALSE(problem.has_value()) << problem->message;
  }
  session->step(kCornerTicks / 2);
  ASSERT_TRUE(ticks_reach(*session, kCornerTicks));
  ASSERT_FALSE(session->stop_recording());
}

TEST(CornerSession, RecordsWhatAHeadlessRunOfItsSidecarGives) {
  const TemporaryFolder folder;
  Scene changed = corner_scene();
  changed.algorithm = test::algorithm(0);
  changed.y->walls[0].stiffness_n_per_m = 77.0;
  changed.y->device.mass_kg = 0.3;
  for (const std::optional<Scene>& change : {std::optional<Scene>(), std::optional(changed)}) {
    const std::string csv = folder.file(change ? "changed.csv" : "plain.csv");
    record(csv, change);
    const auto loaded = file::load_scene(folder.file(change ? "changed.toml" : "plain.toml"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    ASSERT_EQ(loaded->changes.size(), change ? 1U : 0U);
    EXPECT_EQ(text_of(csv), headless_csv(*loaded));
    if (!change) continue;
    EXPECT_EQ(loaded->changes[0].scene.y->walls[0].stiffness_n_per_m, 77.0);
    EXPECT_EQ(loaded->changes[0].scene.y->device.mass_kg, 0.3);
    EXPECT_EQ(loaded->changes[0].scene.device.mass_kg, corner_scene().device.mass_kg);
  }
}

TEST(CornerSession, HandsOutBothAxesTickByTick) {
  const auto session = started_paused(corner_scene());
  session->step(kCornerTicks);
  ASSERT_TRUE(ticks_reach(*session, kCornerTicks));
  std::vector<Sample> x(100);
  std::vector<Sample> y(100);
  std::uint64_t next = 0;
  while (const std::size_t count = session->take_samples(x)) {
    ASSERT_EQ(session->take_second_axis(std::span(y).first(count)), count);
    for (std::size_t i = 0; i < count; ++i, ++next) {
      EXPECT_EQ(x[i].tick, next);
      EXPECT_EQ(y[i].tick, next);
    }
  }
  EXPECT_EQ(next, kCornerTicks);
  const Snapshot snapshot = session->snapshot();
  EXPECT_EQ(snapshot.y.tick, kCornerTicks - 1);
  EXPECT_NE(snapshot.y.truth.position_m, snapshot.sample.truth.position_m);
}

TEST(CornerSession, ThePointerLeadsEitherHand) {
  const auto session = started_paused(corner_scene());
  session->lead_second_hand(0.041);
  session->step(10);
  ASSERT_TRUE(ticks_reach(*session, 10));
  const Snapshot led = session->snapshot();
  EXPECT_NE(led.y.truth.hand_path_m, led.sample.truth.hand_path_m);
  EXPECT_EQ(led.y.truth.hand_path_m, 0.041);
}

TEST(CornerSession, APlotQueueThatIsFullLosesBothAxesOfATickOrNone) {
  SessionOptions options;
  options.plot_queue_capacity = 64;
  options.start_paused = true;
  const auto session = test::started(corner_scene(), options);
  session->step(kCornerTicks);
  ASSERT_TRUE(ticks_reach(*session, kCornerTicks));
  std::vector<Sample> x(kCornerTicks);
  std::vector<Sample> y(kCornerTicks);
  const std::size_t count = session->take_samples(x);
  ASSERT_GT(count, 0U);
  EXPECT_EQ(count + session->dropped_plot_samples(), kCornerTicks);
  ASSERT_EQ(session->take_second_axis(y), count);
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(x[i].tick, y[i].tick);
}

TEST(CornerSession, ReplaysBothAxes) {
  const TemporaryFolder folder;
  record(folder.file("a.csv"), std::nullopt);
  auto reader = file::RecordingReader::open(folder.file("a.csv"));
  ASSERT_TRUE(reader.ok()) << reader.error().message;
  EXPECT_TRUE(file::has_second_axis((*reader)->info().scanned.columns));
  std::vector<Sample> x(kCornerTicks);
  std::vector<Sample> y(kCornerTicks);
  const auto count = (*reader)->read(0, x, y);
  ASSERT_TRUE(count.ok());
  ASSERT_EQ(*count, kCornerTicks);
  std::string text = file::csv_header(file::more_columns(true, true)) + "\n";
  for (std::size_t i = 0; i < kCornerTicks; ++i)
    file::append_csv_row(text, x[i], file::more_columns(true, true), y[i]);
  EXPECT_EQ(text, text_of(folder.file("a.csv")));
  auto replay = start_replay(folder.file("a.csv"), {.start_paused = true});
  ASSERT_TRUE(replay.ok());
  (*replay)->seek(0.3);
  const std::size_t taken = (*replay)->take_samples(x);
  ASSERT_GT(taken, 0U);
  EXPECT_EQ((*replay)->take_second_axis(y), taken);
  EXPECT_EQ(y[taken - 1].tick, (*replay)->snapshot().y.tick);
  EXPECT_EQ(y[taken - 1].force_n, (*replay)->snapshot().y.force_n);
}

TEST(CornerSession, WhatNeedsANewSessionIsNamedOnEitherAxis) {
  const Scene scene = corner_scene();
  const auto key_of = [&](const auto& change) {
    Scene wanted = scene;
    change(wanted);
    const auto problem = needs_new_session(scene, wanted);
    return problem ? problem->key : std::string();
  };
  EXPECT_EQ(key_of([](Scene& s) { s.y->device.mass_kg = 1.0; }), "");
  EXPECT_EQ(key_of([](Scene& s) { s.y->device.start_m = 0.04; }), "device.y.start_m");
  EXPECT_EQ(key_of([](Scene& s) { s.y->hand->path[0].position_m = 0.04; }), "hand.y.path");
  EXPECT_EQ(key_of([](Scene& s) { s.y->hand.reset(); }), "hand.y");
  EXPECT_EQ(key_of([](Scene& s) { s.y.reset(); }), "device.y");
  Scene walls = scene;
  walls.y->walls.clear();
  EXPECT_FALSE(same_parameters(scene, walls));
}

}  // namespace
}  // namespace hapticwall::runtime
