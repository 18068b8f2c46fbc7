// What is recorded and exported through the window: the files say what was done.
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "app/file/recording/recording_reader.h"
#include "core/stabiliser/stabiliser.h"
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
    EXPECT_EQ(person.recording().state, runtime::RecordingState::kRecording);
  }

  static void stop(Person& person) {
    person.put_everything_away();
    person.click("record");
    EXPECT_EQ(person.recording().state, runtime::RecordingState::kIdle);
    EXPECT_EQ(person.recording().dropped_rows, 0U);
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

TEST_P(RecordingWindowTest, HoldsEverySwitchOfTheAlgorithm) {
  constexpr std::uint64_t kTicksOfEach = 50;
  std::vector<std::size_t> switched;
  std::string path;
  use([&](Person& person) {
    start(person);
    path = person.recording().path;
    for (std::size_t i = 0; i < algorithms().size(); ++i) {
      if (person.scene().algorithm.index == i) continue;
      person.click(std::string(algorithms()[i].name));
      EXPECT_EQ(person.scene().algorithm.index, i);
      switched.push_back(i);
      person.wait_for_ticks(kTicksOfEach);
    }
    stop(person);
  });
  const auto reader = read(path);
  ASSERT_NE(reader, nullptr);
  expect_whole(*reader);
  EXPECT_GE(reader->rows(), kTicksOfEach * switched.size());
  std::vector<std::size_t> written;
  for (const ScheduledChange& change : reader->info().loaded.changes)
    written.push_back(change.scene.algorithm.index);
  EXPECT_EQ(written, switched);
}

TEST_P(RecordingWindowTest, IsRepeatableWithTheValuesThatWereChangedMeanwhile) {
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

TEST_P(RecordingWindowTest, IsFinishedWhenTheWindowIsClosed) {
  std::string path;
  use([&](Person& person) {
    start(person);
    path = person.recording().path;
    person.wait_until([&] { return person.recording().rows > 100; }, "rows");
    EXPECT_FALSE(std::filesystem::exists(path)) << "it has its name only when it is whole";
  });
  EXPECT_FALSE(std::filesystem::exists(path + ".partial"));
  const auto reader = read(path);
  ASSERT_NE(reader, nullptr);
  expect_whole(*reader);
  EXPECT_GT(reader->rows(), 100U);
}

TEST_P(RecordingWindowTest, EndsWithTheSceneAndNeverReplacesAFile) {
  use([&](Person& person) {
    for (int i = 0; i < 2; ++i) {
      start(person);
      person.wait_until([&] { return person.recording().rows > 10; }, "rows");
      person.put_everything_away();
      person.click("Figure 6");
      person.wait_until([&] { return person.recording().state == runtime::RecordingState::kIdle; },
                        "its end");
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

TEST_P(RecordingWindowTest, ExportsWhatIsSeen) {
  double from_s = 0.0;
  double to_s = 0.0;
  use([&](Person& person) {
    person.wait_for_ticks(400);
    person.click("follow");
    for (const char* figure : {"as Figure 4", "all plots"}) {
      person.click("arrangement");
      person.wait_a_frame();
      person.click(figure);
      person.click("export png");
      EXPECT_TRUE(person.message().text.starts_with("exported the figure"))
          << person.message().text;
      person.put_everything_away();
    }
    from_s = person.state().transient.time_from_s;
    to_s = person.state().transient.time_to_s;
    person.click("export csv");
    person.wait_until([&] { return person.message().text.starts_with("exported"); }, "the CSV");
  });
  const auto pictures = home_.files(".png");
  EXPECT_EQ(pictures.size(), 2U);
  for (const std::string& path : pictures) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << path;
    EXPECT_EQ(image.width, 1600U);
    EXPECT_EQ(image.height, 1200U);
    png_image_free(&image);
  }
  const auto files = home_.files(".csv");
  ASSERT_EQ(files.size(), 1U);
  const auto reader = read(files.front());
  ASSERT_NE(reader, nullptr);
  EXPECT_GE(reader->rows(), 300U);
  EXPECT_EQ(reader->info().scanned.missing_rows, 0U);
  std::array<Tick, 1> first{};
  std::array<Tick, 1> last{};
  ASSERT_TRUE(reader->read(0, first).ok());
  ASSERT_TRUE(reader->read(reader->rows() - 1, last).ok());
  EXPECT_GE(first.front().x().time_s, from_s);
  EXPECT_LE(last.front().x().time_s, to_s);
}

HAPTICWALL_ON_BOTH_SCREENS(RecordingWindowTest);

}  // namespace
}  // namespace hapticwall::test
