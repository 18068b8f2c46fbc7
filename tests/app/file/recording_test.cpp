// Recordings: exact rows, and names only for complete files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cerrno>
#include <charconv>
#include <clocale>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "app/file/disk/sha256.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/scene/scene_file.h"
#include "tests/app/file/faulty_disk.h"
#include "tests/app/file/recording_support.h"

namespace hapticwall::file {
namespace {

using test::headless;
using test::Recording;
using test::sample_at;
using test::scene_of_ten_ticks;
using test::tick_at;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> parts;
  std::stringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

std::uint64_t bits_of(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_TRUE(code == std::errc{} && end == text.data() + text.size()) << text;
  return std::bit_cast<std::uint64_t>(value);
}

TEST_F(Recording, HeaderIsThePromisedOne) {
  const std::string common =
      "tick,time_s,position_m,velocity_m_per_s,penetration_m,wall_force_n,force_n,"
      "stiffness_n_per_m,energy_cv_j,energy_hold_j,energy_scv_j,energy_budget_j,flags";
  EXPECT_EQ(csv_header(csv_columns(false)), common + ",device_time_s,read_age_s,applied_force_n");
  EXPECT_EQ(csv_header(csv_columns(true)),
            common +
                ",true_position_m,true_velocity_m_per_s,hand_path_m,hand_force_n,"
                "true_actuator_work_j,true_dissipation_j,true_hand_work_j,kinetic_j");
}

// Every field has a distinct value, to detect swapped columns.
TEST_F(Recording, ColumnsStandUnderTheirNames) {
  Sample sample;
  sample.tick = 1;
  double* const numbers[] = {
      &sample.time_s,        &sample.position_m,   &sample.velocity_m_per_s,  &sample.penetration_m,
      &sample.wall_force_n,  &sample.force_n,      &sample.stiffness_n_per_m, &sample.energy_cv_j,
      &sample.energy_hold_j, &sample.energy_scv_j, &sample.energy_budget_j};
  double next = 2.0;
  for (double* number : numbers) *number = next++;
  sample.flags = 13;
  next = 14.0;
  PlantTruth& truth = sample.truth;
  double* const truths[] = {&truth.position_m,   &truth.velocity_m_per_s, &truth.hand_path_m,
                            &truth.hand_force_n, &truth.actuator_work_j,  &truth.dissipation_j,
                            &truth.hand_work_j,  &truth.kinetic_j};
  for (double* number : truths) *number = next++;
  sample.device_time_s = 22.0;
  sample.read_age_s = 23.0;
  sample.applied_force_n = 24.0;
  std::string row;
  append_csv_row(row, {{sample}}, csv_columns(true));
  EXPECT_EQ(row, "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21\n");
  row.clear();
  append_csv_row(row, {{sample}}, csv_columns(false));
  EXPECT_EQ(row, "1,2,3,4,5,6,7,8,9,10,11,12,13,22,23,24\n");
}

class CommaDecimal : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST_F(Recording, NumbersAreExactWhateverTheLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaDecimal));
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // if the machine has this locale
  std::string row;
  append_csv_row(row, tick_at(1234567), csv_columns(true));
  std::setlocale(LC_NUMERIC, "C");
  std::locale::global(before);

  row.pop_back();
  const std::vector<std::string> parts = fields(row);
  ASSERT_EQ(parts.size(), 21U);
  EXPECT_EQ(parts[0], "1234567");
  EXPECT_EQ(parts[1], "1234.567");
  EXPECT_EQ(parts[2], "0.30000000000000004");
  EXPECT_EQ(bits_of(parts[2]), std::bit_cast<std::uint64_t>(0.1 + 0.2));
  EXPECT_EQ(bits_of(parts[6]), std::bit_cast<std::uint64_t>(-0.0));
  EXPECT_EQ(bits_of(parts[8]), std::bit_cast<std::uint64_t>(5e-324));
  EXPECT_EQ(parts[12], "33");
  EXPECT_EQ(bits_of(parts[20]), std::bit_cast<std::uint64_t>(1.7976931348623157e308));
}

TEST_F(Recording, ScenesAreWrittenTheSameWhateverTheLocale) {
  const std::string before = scene_to_toml(scene_of_ten_ticks());
  const std::locale locale = std::locale::global(std::locale(std::locale(), new CommaDecimal));
  const std::string text = scene_to_toml(scene_of_ten_ticks());
  const Result<LoadedScene> loaded = parse_scene(text, "x.toml");
  std::locale::global(locale);
  EXPECT_EQ(text, before);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.duration_s, 0.01);
}

TEST_F(Recording, TakesItsNamesWhenItIsWhole) {
  put("a.csv", "old");
  const auto writer = begun("a.csv", 0, 10);
  ASSERT_FALSE(writer->flush());
  EXPECT_EQ(content("a.csv"), "old");
  EXPECT_THAT(content("a.csv.partial"), StartsWith(csv_header(csv_columns(true)) + "\n0,0,"));
  ASSERT_FALSE(writer->finish(scene_of_ten_ticks(), headless()));
  EXPECT_EQ(writer->rows(), 10U);
  EXPECT_THAT(files(), ::testing::UnorderedElementsAre("a.csv", "a.toml"));

  const std::string csv = content("a.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 11);
  Sha256 digest;
  digest.update(csv);
  const std::string sidecar = content("a.toml");
  EXPECT_THAT(sidecar, HasSubstr("csv_sha256 = \"" + digest.finish() + "\""));
  EXPECT_THAT(sidecar, HasSubstr("\nrows = 10\ndropped_rows = 0\ncomplete = true\n"));
  EXPECT_THAT(sidecar, ::testing::Not(HasSubstr("start_time")));
}

TEST_F(Recording, SidecarSaysHowToRepeat) {
  const auto writer = begun("a.csv", 5, 3);
  RecordingMetadata metadata = headless();
  metadata.first_tick = 5;
  metadata.start_time = "2020-01-01T00:00:00Z";
  metadata.repeatable = false;
  metadata.not_repeatable_because = "the \"pointer\" \\ \t";
  ScheduledChange change{6, scene_of_ten_ticks()};
  change.scene.x().walls = {{0.05, 1000.0, 0.5}};
  metadata.changes.push_back(change);
  ASSERT_FALSE(writer->finish(scene_of_ten_ticks(), metadata));

  const Result<LoadedScene> loaded = load_scene(path("a.toml"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->first_recorded_tick, 5U);
  EXPECT_EQ(loaded->scene.tick_count(), 8U);  // the length of the session
  EXPECT_EQ(loaded->not_repeatable_because, metadata.not_repeatable_because);
  ASSERT_EQ(loaded->changes.size(), 1U);
  EXPECT_EQ(loaded->changes[0].tick, 6U);
  ASSERT_EQ(loaded->changes[0].scene.x().walls.size(), 1U);
  EXPECT_EQ(loaded->changes[0].scene.x().walls[0].damping_n_s_per_m, 0.5);
  EXPECT_THAT(content("a.toml"), HasSubstr("start_time = \"2020-01-01T00:00:00Z\""));
}

TEST_F(Recording, AbandonedItTakesNoName) {
  ASSERT_FALSE(begun("a.csv", 0, 1)->flush());
  EXPECT_THAT(files(), ::testing::ElementsAre("a.csv.partial"));
  static_cast<void>(begun());  // a recording without a row
  EXPECT_TRUE(files().empty());
}

TEST_F(Recording, NanIsNeverWritten) {
  const auto writer = begun("a.csv", 0, 1);
  Sample bad = sample_at(1);
  bad.truth.position_m = std::numeric_limits<double>::quiet_NaN();
  ASSERT_FALSE(writer->append({{bad}}));
  ASSERT_FALSE(writer->finish(scene_of_ten_ticks(), headless()));
  EXPECT_EQ(writer->rows(), 1U);
  EXPECT_THAT(content("a.toml"), HasSubstr("complete = true"));  // nothing came after it
}

TEST_F(Recording, AHoleIsToldOf) {
  const auto writer = begun();
  Sample bad = sample_at(1);
  bad.force_n = std::numeric_limits<double>::infinity();
  for (const Sample& sample : {sample_at(0), bad, sample_at(2)}) {
    ASSERT_FALSE(writer->append({{sample}}));
  }
  ASSERT_FALSE(writer->finish(scene_of_ten_ticks(), headless()));
  EXPECT_THAT(content("a.toml"), HasSubstr("rows = 2\ndropped_rows = 1\ncomplete = false\n"));
}

TEST_F(Recording, ASyncAsksTheDiskAndKeepsItsError) {
  const auto writer = begun("a.csv", 0, 10);
  ASSERT_FALSE(writer->sync());
  EXPECT_THAT(content("a.csv.partial"), HasSubstr("\n9,"));
  test::FaultyDisk disk;
  disk.fail_sync(EIO);
  EXPECT_TRUE(writer->sync());
  EXPECT_TRUE(writer->append(tick_at(10)));
}

TEST_F(Recording, AFullDiskIsAnErrorAndStaysOne) {
  const auto writer = begun("a.csv", 0, 1);
  test::FaultyDisk disk;
  disk.fail_after(0, ENOSPC);
  const Failure failed = writer->flush();
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->kind, ErrorKind::kFile);
  EXPECT_THAT(failed->message, HasSubstr("a.csv: could not be written: No space left"));
  EXPECT_TRUE(writer->append(tick_at(1)));
  EXPECT_TRUE(writer->finish(scene_of_ten_ticks(), headless()));
  EXPECT_FALSE(fs::exists(path("a.csv")) || fs::exists(path("a.toml")));
}

}  // namespace
}  // namespace hapticwall::file
