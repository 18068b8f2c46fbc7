#include "app/ui/state/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/run/simulate.h"
#include "tests/temporary_folder.h"

namespace hapticwall::ui {
namespace {

using ::testing::HasSubstr;

class ExportTest : public test::FolderTest {
 protected:
  void SetUp() override {
    scene_ = file::load_scene("press")->scene;
    scene_.duration_s = 2.5;
    SimulationOptions options;
    options.on_sample = [this](const Sample& sample) { samples_.push_back(sample); };
    static_cast<void>(simulate(scene_, options));
    history_.push(samples_);
  }

  [[nodiscard]] std::string expected_csv(std::size_t first, std::size_t last,
                                         const file::CsvColumns& columns) const {
    std::string text = file::csv_header(columns) + "\n";
    for (std::size_t i = first; i < last; ++i) file::append_csv_row(text, {{samples_[i]}}, columns);
    return text;
  }

  Scene scene_;
  std::vector<Sample> samples_;
  draw::SampleHistory history_{100000};
};

TEST_F(ExportTest, TheRowsAreThoseOfARecordingByteForByte) {
  const auto rows = export_csv(history_, {500, 2100}, {scene_, true, "simulator"}, path("a.csv"));
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  EXPECT_EQ(*rows, 1600U);
  EXPECT_EQ(content("a.csv"), expected_csv(500, 2100, file::csv_columns(true)));
}

TEST_F(ExportTest, TheSidecarDescribesTheExport) {
  ASSERT_TRUE(export_csv(history_, {500, 2100}, {scene_, true, "simulator"}, path("a.csv")).ok());
  const std::string sidecar = content("a.toml");
  EXPECT_THAT(sidecar, HasSubstr("first_tick = 500"));
  EXPECT_THAT(sidecar, HasSubstr("rows = 1600"));
  EXPECT_THAT(sidecar, HasSubstr("complete = true"));
  EXPECT_THAT(sidecar, HasSubstr("repeatable = false"));
  EXPECT_THAT(sidecar, HasSubstr("exported"));
}

TEST_F(ExportTest, AnExportFromADeviceHasTheColumnsOfADevice) {
  ASSERT_TRUE(export_csv(history_, {10, 20}, {scene_, false, "paddle"}, path("a.csv")).ok());
  EXPECT_EQ(content("a.csv"), expected_csv(10, 20, file::csv_columns(false)));
  EXPECT_THAT(content("a.toml"), HasSubstr("paddle"));
}

TEST_F(ExportTest, HolesAreCounted) {
  draw::SampleHistory holes(1000);
  for (const std::size_t tick : {3U, 4U, 7U, 8U, 12U}) holes.push(samples_[tick]);
  ASSERT_TRUE(export_csv(holes, {0, 5}, {scene_, true, "simulator"}, path("a.csv")).ok());
  const std::string sidecar = content("a.toml");
  EXPECT_THAT(sidecar, HasSubstr("dropped_rows = 5"));
  EXPECT_THAT(sidecar, HasSubstr("complete = false"));
}

TEST_F(ExportTest, AJobWritesWhatTheHistoryWasWhileItGoesOn) {
  ExportJob job;
  EXPECT_FALSE(job.take().has_value());
  job.start(history_, {0, 2400}, {scene_, true, "simulator"}, path("a.csv"));
  EXPECT_TRUE(job.running());
  history_.push(samples_.front());  // a reset: everything is forgotten here
  std::optional<ExportJob::Outcome> outcome;
  while (!outcome) outcome = job.take();
  ASSERT_TRUE(outcome->rows.ok()) << outcome->rows.error().message;
  EXPECT_EQ(*outcome->rows, 2400U);
  EXPECT_EQ(outcome->path, path("a.csv"));
  EXPECT_FALSE(job.running());
  EXPECT_EQ(content("a.csv"), expected_csv(0, 2400, file::csv_columns(true)));
}

TEST_F(ExportTest, NamesTellSceneAlgorithmAndRangeInPlainCharacters) {
  Scene scene = scene_;
  scene.name = "my/scene näme";
  scene.algorithm.index = 0;
  const std::string name = export_name(scene, 1.25, 7.5);
  EXPECT_THAT(name, HasSubstr("-none-1.250-7.500s"));
  EXPECT_EQ(name.find_first_of("/ "), std::string::npos);
}

TEST_F(ExportTest, NoNameLeadsElsewhereOrHidesAFile) {
  EXPECT_EQ(plain_file_name("../../x"), "_.-..-x");
  EXPECT_EQ(plain_file_name("/etc/x"), "_etc-x");
  EXPECT_EQ(plain_file_name(std::string("a\0b", 3)), "a-b");
  EXPECT_EQ(plain_file_name("\x1b[2J\x7f"), "_-2J-");
  EXPECT_EQ(plain_file_name("-rf *"), "_rf--");
  EXPECT_EQ(plain_file_name(".."), "_.");
  EXPECT_EQ(plain_file_name(std::string(300, 'n')), std::string(200, 'n'));
}

TEST_F(ExportTest, AnUnusedPathNamesNoExistingFile) {
  EXPECT_EQ(unused_path(folder_.path().string(), "a", ".png"), path("a.png"));
  put("a.png", "x");
  EXPECT_EQ(unused_path(folder_.path().string(), "a", ".png"), path("a-2.png"));
  put("a-2.png", "x");
  EXPECT_EQ(unused_path(folder_.path().string(), "a", ".png"), path("a-3.png"));
}

}  // namespace
}  // namespace hapticwall::ui
