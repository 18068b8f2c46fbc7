// Recordings made in the window: the files hold everything that was done.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "app/file/recording/recording_reader.h"
#include "tests/window/window_test.h"

namespace hapticwall::test {
namespace {

class RecordingWindowTest : public WindowTest {
 protected:
  static std::unique_ptr<file::RecordingReader> read(const std::string& path) {
    auto reader = file::RecordingReader::open(path);
    EXPECT_TRUE(reader.ok()) << reader.error().message;
    return reader ? std::move(*reader) : nullptr;
  }

  static void start(Person& person) {
    person.click("record");
    EXPECT_EQ(person.recording().state, session::RecordingState::kRecording);
  }

  static void stop(Person& person) {
    person.put_everything_away();
    person.click("record");
    EXPECT_EQ(person.recording().state, session::RecordingState::kIdle);
    EXPECT_EQ(person.recording().dropped_rows, 0U);
  }

  static std::string record(Person& person) {
    start(person);
    std::string path = person.recording().path;
    person.wait_for_ticks(20);
    stop(person);
    return path;
  }
  static std::vector<file::SignalColumn> signals_of(const std::string& path) {
    const auto reader = read(path);
    return reader ? reader->info().scanned.columns.signals : std::vector<file::SignalColumn>{};
  }
  static void tick_signals(Person& person) {
    person.click("settings");
    person.click("record signals");
    person.put_everything_away();
  }

  static void expect_whole(const file::RecordingReader& reader) {
    const file::ScannedRows& scanned = reader.info().scanned;
    EXPECT_EQ(scanned.missing_rows, 0U);
    EXPECT_FALSE(scanned.cut_off);
    EXPECT_EQ(scanned.last_tick - scanned.first_tick + 1, scanned.rows);
    EXPECT_TRUE(reader.info().has_sidecar);
    EXPECT_TRUE(reader.info().notes.empty()) << reader.info().notes.front();
  }
};

TEST_F(RecordingWindowTest, IsRepeatableWithTheValuesThatWereChangedMeanwhile) {
  std::string path;
  use([&](Person& person) {
    start(person);
    path = person.recording().path;
    person.type("stiffness", "12345");
    person.wait_for_ticks(20);
    person.drag("damping-slider", ImVec2(40.0F, 0.0F));
    person.wait_for_ticks(20);
    person.press(ImGuiMod_Ctrl | ImGuiKey_Z);
    person.wait_for_ticks(20);
    stop(person);
  });
  const auto reader = read(path);
  ASSERT_NE(reader, nullptr);
  expect_whole(*reader);
  const file::LoadedScene& loaded = reader->info().loaded;
  EXPECT_EQ(loaded.not_repeatable_because, "");
  ASSERT_GE(loaded.changes.size(), 3U);
  EXPECT_EQ(loaded.changes.front().scene.x().walls.front().stiffness_n_per_m, 12345.0);
  const WallSettings& last = loaded.changes.back().scene.x().walls.front();
  EXPECT_EQ(last.stiffness_n_per_m, 12345.0);
  EXPECT_EQ(last.damping_n_s_per_m, options_.scene.x().walls.front().damping_n_s_per_m)
      << "the drag was one step to undo";
}

TEST_F(RecordingWindowTest, IsFinishedWhenTheWindowIsClosed) {
  std::string path;
  use([&](Person& person) {
    start(person);
    path = person.recording().path;
    person.wait_until([&] { return person.recording().rows > 100; }, "rows");
    EXPECT_FALSE(std::filesystem::exists(path)) << "a partial recording has another name";
  });
  EXPECT_FALSE(std::filesystem::exists(path + ".partial"));
  const auto reader = read(path);
  ASSERT_NE(reader, nullptr);
  expect_whole(*reader);
  EXPECT_GT(reader->rows(), 100U);
}

TEST_F(RecordingWindowTest, EndsWithTheSceneAndNeverReplacesAFile) {
  use([&](Person& person) {
    for (int i = 0; i < 2; ++i) {
      start(person);
      person.wait_until([&] { return person.recording().rows > 10; }, "rows");
      person.put_everything_away();
      person.state().plots.persisted.arrangement = ui::PlotArrangement::kFigure4;
      person.wait_a_frame();
      person.click("Figure 6");
      person.wait_until([&] { return person.recording().state == session::RecordingState::kIdle; },
                        "the end of the recording");
    }
  });
  const auto files = home_.files(".csv");
  ASSERT_EQ(files.size(), 2U);
  for (const std::string& path : files) {
    const auto reader = read(path);
    ASSERT_NE(reader, nullptr);
    expect_whole(*reader);
  }
}

TEST_F(RecordingWindowTest, HasTheSignalsOfAlgorithmsIfTheyAreTicked) {
  const auto record_thrice = [](Person& person) {
    EXPECT_TRUE(signals_of(record(person)).empty());
    tick_signals(person);
    EXPECT_EQ(signals_of(record(person)), file::all_signal_columns());
    tick_signals(person);
    EXPECT_TRUE(signals_of(record(person)).empty());
    tick_signals(person);
  };
  use(record_thrice);
  use([](Person& person) { EXPECT_EQ(signals_of(record(person)), file::all_signal_columns()); });
}

TEST_F(RecordingWindowTest, HasTheSignalsOfTheCommandLineForThisStart) {
  options_.signals = file::all_signal_columns();
  use([](Person& person) {
    EXPECT_EQ(signals_of(record(person)), file::all_signal_columns());
    EXPECT_FALSE(person.state().recording.chosen_signals);
    tick_signals(person);
    EXPECT_TRUE(signals_of(record(person)).empty());
  });
}

}  // namespace
}  // namespace hapticwall::test
