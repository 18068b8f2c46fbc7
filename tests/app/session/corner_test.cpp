// A live session of two axes: the rows of a headless run, replayed and repeated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "app/file/recording/recording_reader.h"
#include "app/session/hand_rerun.h"
#include "app/session/live_session.h"
#include "app/session/replay_session.h"
#include "app/session/scene_change.h"
#include "core/environment/environment.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;
using test::started_paused;
using test::TemporaryFolder;
using test::text_of;
using test::ticks_reach;

constexpr std::uint64_t kCornerTicks = 600;

Scene corner_scene() {
  Scene scene = contact_scene();
  scene.axes.assign(2, scene.x());
  scene.axes[1].device.mass_kg *= 2.0;
  scene.axes[1].walls[0].stiffness_n_per_m *= 0.5;
  return scene;
}

std::string headless_csv(const file::LoadedScene& loaded) {
  const auto columns = file::csv_columns(true, 2);
  std::string text = file::csv_header(columns) + "\n";
  AxesOptions options;
  options.changes = loaded.changes;
  options.on_tick = [&](const Tick& tick) { file::append_csv_row(text, tick, columns); };
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
  changed.axes[1].walls[0].stiffness_n_per_m = 77.0;
  changed.axes[1].device.mass_kg = 0.3;
  for (const std::optional<Scene>& change : {std::optional<Scene>(), std::optional(changed)}) {
    const std::string csv = folder.file(change ? "changed.csv" : "plain.csv");
    record(csv, change);
    const auto loaded = file::load_scene(folder.file(change ? "changed.toml" : "plain.toml"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    ASSERT_EQ(loaded->changes.size(), change ? 1U : 0U);
    EXPECT_EQ(text_of(csv), headless_csv(*loaded));
    if (!change) continue;
    EXPECT_EQ(loaded->changes[0].scene.axes[1].walls[0].stiffness_n_per_m, 77.0);
    EXPECT_EQ(loaded->changes[0].scene.axes[1].device.mass_kg, 0.3);
    EXPECT_EQ(loaded->changes[0].scene.x().device.mass_kg, corner_scene().x().device.mass_kg);
  }
}

TEST(CornerSession, HandsOutBothAxesTickByTick) {
  const auto session = started_paused(corner_scene());
  session->step(kCornerTicks);
  ASSERT_TRUE(ticks_reach(*session, kCornerTicks));
  std::vector<Tick> ticks(100);
  std::uint64_t next = 0;
  while (const std::size_t count = session->take_ticks(ticks)) {
    for (std::size_t i = 0; i < count; ++i, ++next) {
      ASSERT_EQ(ticks[i].count, 2U);
      for (const Sample& sample : ticks[i].in_use()) EXPECT_EQ(sample.tick, next);
    }
  }
  EXPECT_EQ(next, kCornerTicks);
  const Snapshot snapshot = session->snapshot();
  EXPECT_EQ(snapshot.newest.axes[1].tick, kCornerTicks - 1);
  EXPECT_NE(snapshot.newest.axes[1].truth.position_m, snapshot.newest.x().truth.position_m);
}

TEST(CornerSession, ThePointerLeadsEitherHand) {
  const auto session = started_paused(corner_scene());
  session->move_hand(test::hand_to(0.041, 1));
  session->step(10);
  ASSERT_TRUE(ticks_reach(*session, 10));
  const Snapshot led = session->snapshot();
  EXPECT_NE(led.newest.axes[1].truth.hand_path_m, led.newest.x().truth.hand_path_m);
  EXPECT_EQ(led.newest.axes[1].truth.hand_path_m, 0.041);
}

TEST(CornerSession, APlotQueueThatIsFullLosesBothAxesOfATickOrNone) {
  SessionOptions options;
  options.queues.plot = 64;
  options.start_paused = true;
  const auto session = test::started(corner_scene(), options);
  session->step(kCornerTicks);
  ASSERT_TRUE(ticks_reach(*session, kCornerTicks));
  std::vector<Tick> ticks(kCornerTicks);
  const std::size_t count = session->take_ticks(ticks);
  ASSERT_GT(count, 0U);
  EXPECT_EQ(count + session->dropped_plot_samples(), kCornerTicks);
  for (const Tick& tick : std::span(ticks).first(count)) {
    EXPECT_EQ(tick.axes[0].tick, tick.axes[1].tick);
  }
}

TEST(CornerSession, ReplaysBothAxes) {
  const TemporaryFolder folder;
  record(folder.file("a.csv"), std::nullopt);
  auto reader = file::RecordingReader::open(folder.file("a.csv"));
  ASSERT_TRUE(reader.ok()) << reader.error().message;
  const file::CsvColumns columns = (*reader)->info().scanned.columns;
  EXPECT_EQ(columns, file::csv_columns(true, 2));
  std::vector<Tick> ticks(kCornerTicks);
  const auto count = (*reader)->read(0, ticks);
  ASSERT_TRUE(count.ok());
  ASSERT_EQ(*count, kCornerTicks);
  std::string text = file::csv_header(columns) + "\n";
  for (const Tick& tick : ticks) file::append_csv_row(text, tick, columns);
  EXPECT_EQ(text, text_of(folder.file("a.csv")));
  auto replay = start_replay(folder.file("a.csv"), {.start_paused = true});
  ASSERT_TRUE(replay.ok());
  (*replay)->seek(0.3);
  const std::size_t taken = (*replay)->take_ticks(ticks);
  ASSERT_GT(taken, 0U);
  const Sample& y = ticks[taken - 1].axes[1];
  EXPECT_EQ(y.tick, (*replay)->snapshot().newest.axes[1].tick);
  EXPECT_EQ(y.force_n, (*replay)->snapshot().newest.axes[1].force_n);
}

// Axes that need each other from the middle of the session on.
TEST(CornerSession, RecordsABumpAsAHeadlessRunGivesItAndRefusesToRunOneAxisAgain) {
  const TemporaryFolder folder;
  Scene bump = corner_scene();
  for (AxisSettings& axis : bump.axes) axis.walls.clear();
  bump.environment.index = find_environment("bump").value();
  record(folder.file("a.csv"), bump);
  const auto loaded = file::load_scene(folder.file("a.toml"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->changes.size(), 1U);
  EXPECT_EQ(loaded->changes[0].scene.environment, bump.environment);
  EXPECT_EQ(text_of(folder.file("a.csv")), headless_csv(*loaded));
  const auto reader = file::RecordingReader::open(folder.file("a.csv"));
  ASSERT_TRUE(reader);
  const auto scene = rerun_scene((*reader)->info(), "none", {});
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, ::testing::HasSubstr("its axes need each other"));
}

TEST(CornerSession, NamesAChangeOfEitherAxisThatNeedsANewSession) {
  const Scene scene = corner_scene();
  const auto key_of = [&](const auto& change) {
    Scene wanted = scene;
    change(wanted);
    const auto problem = needs_new_session(scene, wanted);
    return problem ? problem->key : std::string();
  };
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].device.mass_kg = 1.0; }), "");
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].device.start_m = 0.04; }), "device.y.start_m");
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].hand->path.edit()[0].position_m = 0.04; }),
            "hand.y.path");
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].hand.reset(); }), "hand.y");
  EXPECT_EQ(key_of([](Scene& s) { s.axes.resize(1); }), "device.y");
  Scene walls = scene;
  walls.axes[1].walls.clear();
  EXPECT_FALSE(same_parameters(scene, walls));
}

}  // namespace
}  // namespace hapticwall::session
