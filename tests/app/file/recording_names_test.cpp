// The names of a recording: it replaces no other file, is named only when complete, and keeps the
// rest of an earlier one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/recording/recording_reader.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/recording/recovery.h"
#include "app/file/recording/sidecar.h"
#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "tests/app/file/recording_support.h"

namespace hapticwall::file {
namespace {

using test::headless;
using test::Recording;
using test::sample_at;
using test::scene_of_ten_ticks;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

using RecordingNames = Recording;

TEST_F(RecordingNames, AUsersSceneIsNotReplacedByASidecar) {
  put("mine.toml", "name = 'mine'\n");
  const auto writer = RecordingWriter::create(path("mine.csv"), csv_columns(true));
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().kind, ErrorKind::kFile);
  EXPECT_THAT(writer.error().message, HasSubstr("would replace a file that is not a recording's"));
  EXPECT_EQ(content("mine.toml"), "name = 'mine'\n");
}

TEST_F(RecordingNames, AUsersSceneThatCameMeanwhileIsNotReplacedEither) {
  auto writer = begun("mine.csv", 0, 1);
  EXPECT_FALSE(writer->note(scene_of_ten_ticks(), headless()));
  put("mine.toml", "name = 'mine'\n");
  const Failure failed = writer->finish(scene_of_ten_ticks(), headless());
  ASSERT_TRUE(failed);
  EXPECT_THAT(failed->message, HasSubstr("would replace a file that is not a recording's; its rows "
                                         "are in " +
                                         shown(path("mine.csv.partial"))));
  writer.reset();
  EXPECT_EQ(content("mine.toml"), "name = 'mine'\n");
  fs::rename(path("mine.toml"), path("moved.toml"));
  EXPECT_TRUE(recover_recording(path("mine.csv")).ok()) << "the rows are not lost";
}

TEST_F(RecordingNames, OneThatLacksOnlyItsNameIsFinishedAndNotWrittenOver) {
  EXPECT_FALSE(begun("a.csv", 0, 2)->finish(scene_of_ten_ticks(), headless()));
  const std::string csv = content("a.csv");
  fs::rename(path("a.csv"), path("a.csv.partial"));  // as after a kill between the two renames
  const auto refused = RecordingWriter::create(path("a.csv"), csv_columns(true));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("'hapticwall recover "));
  const auto recovered = recover_recording(path("a.csv"));
  ASSERT_TRUE(recovered) << recovered.error().message;
  EXPECT_EQ(recovered->rows, 2U);
  EXPECT_EQ(content("a.csv"), csv);
  EXPECT_EQ(files().size(), 2U);
}

TEST_F(RecordingNames, ASidecarOfOtherRowsIsNotTakenForTheirs) {
  for (const auto& [name, first_tick] : {std::pair{"a.csv", 0U}, {"b.csv", 1U}}) {
    EXPECT_FALSE(begun(name, first_tick, 1)->finish(scene_of_ten_ticks(), headless()));
  }
  fs::rename(path("a.csv"), path("a.csv.partial"));
  EXPECT_TRUE(lacks_only_its_name(path("a.csv")));
  fs::rename(path("b.csv"), path("a.csv.partial"));
  EXPECT_FALSE(lacks_only_its_name(path("a.csv")));
  EXPECT_FALSE(recover_recording(path("a.csv")));
}

TEST_F(RecordingNames, OneThatWasCutOffBeforeItsFirstRowDoesNotBlockItsName) {
  put("a.csv.partial", csv_header(csv_columns(true)) + "\n");
  put("a.toml.partial", "[recording]\n");
  const auto writer = RecordingWriter::create(path("a.csv"), csv_columns(true));
  EXPECT_TRUE(writer) << writer.error().message;
}

TEST_F(RecordingNames, AsManyChangesAsAreKeptAreReadAgain) {
  constexpr std::size_t kWalls = 8;
  Scene scene = scene_of_ten_ticks();
  RecordingMetadata metadata = headless();
  for (std::size_t i = 0; i < kMaxChanges; ++i) {
    ScheduledChange change{1 + i / 2000, scene};
    change.scene.x().device.mass_kg = 0.1234567890123456;
    for (std::size_t wall = 0; wall < kWalls; ++wall) {
      change.scene.x().walls.push_back({0.0501234567890123 + 1e-3 * static_cast<double>(wall),
                                        12345.678901234567, 1.2345678901234567});
    }
    metadata.changes.push_back(std::move(change));
  }
  ASSERT_FALSE(begun("a.csv", 0, 10)->finish(scene, metadata));
  EXPECT_GT(fs::file_size(path("a.toml")), std::uintmax_t{1} << 20U) << "more than a scene has";
  EXPECT_LT(fs::file_size(path("a.toml")), kMaxSidecarBytes / 4);
  const auto loaded = load_scene(path("a.toml"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->changes.size(), kMaxChanges);
  const auto reader = RecordingReader::open(path("a.csv"));
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE((*reader)->info().has_sidecar);
}

TEST_F(RecordingNames, ASessionLongerThanASceneCanBeIsReadAndNotRepeated) {
  RecordingMetadata metadata = headless();
  metadata.first_tick = 1'000'000'000;
  metadata.session_ticks = 1'000'000'001;  // 11.6 days at 1 kHz
  ASSERT_FALSE(begun("a.csv", metadata.first_tick, 1)->finish(scene_of_ten_ticks(), metadata));
  const auto loaded = load_scene(path("a.toml"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_THAT(loaded->not_repeatable_because, HasSubstr("longer than a scene can be"));
}

// The hand is found by its path, however far the rows are from tick 0 and from each other.
TEST_F(RecordingNames, AHandOnItsPathIsFoundThereAtAnyTick) {
  Scene scene = scene_of_ten_ticks();
  scene.x().hand = HandSettings{};
  scene.x().hand->path = {{0.0, 0.03}, {0.0105, 0.031}, {1e5, 0.06}};
  scene.duration_s = 2e5;
  for (const bool led : {false, true}) {
    auto writer = begun();
    ASSERT_FALSE(writer->note(scene, headless()));
    for (const std::uint64_t tick : {200'000'000U, 200'000'001U, 4'000'000'000U}) {
      Sample sample = sample_at(tick);
      sample.truth.hand_path_m = led && tick == 4'000'000'000U ? 0.0601 : 0.06;
      EXPECT_FALSE(writer->append({{sample}}));
    }
    EXPECT_FALSE(writer->flush());
    writer.reset();
    const auto recovered = recover_recording(path("a.csv"));
    ASSERT_TRUE(recovered) << recovered.error().message;
    EXPECT_EQ(content("a.toml").find("something else led it") != std::string::npos, led);
    fs::remove(path("a.csv"));
    fs::remove(path("a.toml"));
  }
}

TEST_F(RecordingNames, OneWriterAtATime) {
  const auto first = AtomicFile::create(path("a"));
  ASSERT_TRUE(first);
  const auto second = AtomicFile::create(path("a"));
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("another process is writing it"));
}

TEST_F(RecordingNames, UnwritablePathsAreRefusedAtOnce) {
  for (const std::string& name : {path("no/a.csv"), path(""), std::string("/dev/null")}) {
    const auto writer = RecordingWriter::create(name, csv_columns(true));
    ASSERT_FALSE(writer) << name;
    EXPECT_EQ(writer.error().kind, ErrorKind::kFile);
  }
}

}  // namespace
}  // namespace hapticwall::file
