// Recordings read back: every digit, every complaint, any stretch.
#include "app/file/recording/recording_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <random>

#include "app/file/recording/recording_rows.h"
#include "app/file/recording/recording_writer.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
namespace fs = std::filesystem;
Sample random_sample(std::uint64_t tick, std::mt19937_64& random) {
  const auto number = [&] {
    double value = 0.0;
    do {
      value = std::bit_cast<double>(random());
    } while (!std::isfinite(value));
    return value;
  };
  Sample sample;
  sample.tick = tick;
  sample.time_s = static_cast<double>(tick) / 1000.0;
  for_each_column(sample, [&]<typename Value>(const SampleColumn& column, Value& value) {
    if constexpr (std::is_same_v<Value, double>) {
      if (column.group != ColumnGroup::kTick) value = number();
    }
  });
  sample.flags = static_cast<std::uint32_t>(random() % 64);
  for (double& value : sample.signals) {
    if (random() % 2 == 0) value = number();
  }
  return sample;
}

std::size_t bound_place() { return find_algorithm_signal("step_bound_n").value(); }

std::string row_of(const Sample& sample, const CsvColumns& columns = {}) {
  std::string text;
  append_csv_row(text, {{sample}}, columns);
  return text;
}

class RecordingReading : public hapticwall::test::FolderTest {
 protected:
  // a.csv and its sidecar, as the writer makes them.
  void record(std::uint64_t first_tick, std::uint64_t rows, CsvColumns columns,
              RecordingMetadata metadata = {}) {
    std::mt19937_64 random(1);
    auto writer = RecordingWriter::create(path("a.csv"), std::move(columns));
    ASSERT_TRUE(writer) << writer.error().message;
    samples_.clear();
    for (std::uint64_t i = 0; i < rows; ++i) {
      samples_.push_back(random_sample(first_tick + i, random));
      ASSERT_FALSE((*writer)->append({{samples_.back()}}));
    }
    Scene scene;
    scene.name = "ten";
    scene.sampling.rate_hz = 500.0;
    scene.x().walls.push_back({0.05, 1000.0, 0.0});
    metadata.device = "simulator";
    metadata.realtime_status = "real-time priority 80";
    metadata.first_tick = first_tick;
    ASSERT_FALSE((*writer)->finish(scene, metadata));
  }
  [[nodiscard]] std::unique_ptr<RecordingReader> opened(const std::string& name = "a.csv") const {
    auto reader = RecordingReader::open(path(name));
    if (!reader) throw std::runtime_error(reader.error().message);
    return std::move(*reader);
  }
  // Message with which open() refuses the file, without the folder.
  [[nodiscard]] std::string refusal(const std::string& name = "a.csv") const {
    const auto reader = RecordingReader::open(path(name));
    if (reader) return "";
    EXPECT_EQ(reader.error().kind, ErrorKind::kUsage);
    const std::size_t folder = reader.error().message.find(folder_.path().string() + "/");
    return folder == 0 ? reader.error().message.substr(folder_.path().string().size() + 1)
                       : reader.error().message;
  }
  [[nodiscard]] static std::string header() { return csv_header(csv_columns(true)) + '\n'; }

  std::vector<Sample> samples_;

 private:
};

void expect_equal(const Sample& read, const Sample& written, const CsvColumns& columns) {
  EXPECT_EQ(row_of(read, columns), row_of(written, columns));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(read.force_n),
            std::bit_cast<std::uint64_t>(written.force_n));
}

// Both axes have the signals; an empty field is NaN, also the last one.
TEST(SignalColumns, StandLastInEachAxis) {
  CsvColumns columns = csv_columns(true, 2);
  columns.signals = {{"step_bound_n", bound_place()}, {"other", kMaxSignals - 1}};
  const std::string header = csv_header(columns);
  EXPECT_THAT(header, HasSubstr(",kinetic_j,signal.step_bound_n,signal.other,y_position_m,"));
  EXPECT_THAT(header, ::testing::EndsWith(",y_kinetic_j,y_signal.step_bound_n,y_signal.other"));
  Tick tick;
  tick.count = 2;
  tick.axes[1].signals[bound_place()] = 0.5;
  std::string row;
  append_csv_row(row, tick, columns);
  EXPECT_THAT(row, HasSubstr(",0,,,0,"));
  EXPECT_THAT(row, ::testing::EndsWith(",0.5,\n"));
  row.pop_back();
  Tick read;
  read.axes[0].signals.fill(1.0);
  EXPECT_EQ(parse_csv_row(row, columns, read), std::nullopt);
  EXPECT_EQ(read.axes[1].signals[bound_place()], 0.5);
  EXPECT_TRUE(std::isnan(read.axes[0].signals[bound_place()]));
  EXPECT_TRUE(std::isnan(read.axes[1].signals[kMaxSignals - 1]));
  EXPECT_NE(parse_csv_row(row.substr(0, row.size() - 1), columns, read), std::nullopt);
  EXPECT_NE(parse_csv_row(row + ",", columns, read), std::nullopt);
  row.insert(row.rfind(",0.5"), "x");
  EXPECT_NE(parse_csv_row(row, columns, read), std::nullopt);
  std::string object;
  append_json_object(object, tick, columns, 0);
  EXPECT_THAT(object, HasSubstr("\"y_signal.step_bound_n\":0.5,\"y_signal.other\":null,"));
}

TEST(SignalColumns, AreThoseOfEachAlgorithmOfARunOnce) {
  Scene scene;
  scene.algorithm.index = find_algorithm("energy-bounding").value();
  ScheduledChange change{5, scene};
  change.scene.algorithm.index = find_algorithm("energy-bounding-2010").value();
  const SignalColumn bound{"step_bound_n", bound_place()};
  EXPECT_THAT(signal_columns(scene, {}), ElementsAre(bound));
  EXPECT_THAT(signal_columns(scene, std::span(&change, 1)),
              ElementsAre(bound, SignalColumn{"store_j", *find_algorithm_signal("store_j")}));
}

TEST(SignalColumns, AloneMayBeEmpty) {
  CsvColumns columns = csv_columns(true);
  columns.signals = {{"step_bound_n", bound_place()}};
  std::string row = row_of(Sample(), columns);
  row.pop_back();
  Tick read;
  ASSERT_EQ(parse_csv_row(row, columns, read), std::nullopt);
  row.replace(row.find("0,0,") + 2, 1, "");
  EXPECT_EQ(parse_csv_row(row, columns, read), "time_s: '' is no finite number");
}

TEST(SignalColumns, AreRefusedInWordsWhereTheyCannotBeRead) {
  const std::string plain = csv_header(csv_columns(true));
  EXPECT_THAT(parse_csv_header(plain + ",signal.a,signal.a").error().message,
              HasSubstr("the signal 'a' has no name of its own"));
  EXPECT_THAT(parse_csv_header(plain + ",signal.").error().message,
              HasSubstr("no name of its own"));
  std::string many = plain;
  for (std::size_t i = algorithm_signals().size(); i < kMaxSignals; ++i)
    many += ",signal.own_" + std::to_string(i);
  EXPECT_TRUE(parse_csv_header(many).ok());
  EXPECT_THAT(parse_csv_header(many + ",signal.one_more").error().message,
              HasSubstr("more than 16 signals"));
}

TEST_F(RecordingReading, GivesBackEveryDigit) {
  CsvColumns older = csv_columns(false);
  older.applied = false;
  CsvColumns signals = csv_columns(true);
  signals.signals = {{"of_a_plugin", algorithm_signals().size()}, {"step_bound_n", bound_place()}};
  for (const CsvColumns& columns : {csv_columns(true), csv_columns(false), older, signals}) {
    record(7, 3000, columns);
    const auto reader = opened();
    ASSERT_EQ(reader->rows(), 3000U);
    EXPECT_EQ(reader->info().scanned.columns, columns);
    std::vector<Tick> read(4000);
    ASSERT_EQ(*reader->read(0, read), 3000U);
    for (std::size_t i = 0; i < samples_.size(); ++i)
      expect_equal(read[i].x(), samples_[i], columns);
    EXPECT_EQ(*reader->read(3000, read), 0U);
  }
}

TEST_F(RecordingReading, AnyStretchAcrossTheBlocksIsThere) {
  record(100, 2 * kRowsPerBlock + 5, csv_columns(true));
  const auto reader = opened();
  std::array<Tick, 20> some;
  for (const std::uint64_t first : {std::uint64_t{0}, kRowsPerBlock - 7, 2 * kRowsPerBlock - 1,
                                    2 * kRowsPerBlock, kRowsPerBlock}) {
    const std::size_t count = *reader->read(first, some);
    EXPECT_EQ(count, std::min<std::uint64_t>(some.size(), reader->rows() - first));
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(some[i].x().tick, 100 + first + i);
  }
  EXPECT_EQ(*reader->row_at(0), 0U);
  EXPECT_EQ(*reader->row_at(100), 0U);
  EXPECT_EQ(*reader->row_at(100 + kRowsPerBlock), kRowsPerBlock);
  EXPECT_EQ(*reader->row_at(99 + kRowsPerBlock), kRowsPerBlock - 1);
  EXPECT_EQ(*reader->row_at(1'000'000), reader->rows());
}

TEST_F(RecordingReading, TheSidecarSaysTheRest) {
  RecordingMetadata metadata;
  metadata.start_time = "2024-05-06T07:08:09Z";
  Scene changed;
  changed.x().walls.push_back({0.04, 500.0, 0.0});
  metadata.changes = {{3, changed}, {5, changed}};
  record(0, 10, csv_columns(true), metadata);
  const auto reader = opened();
  const RecordingInfo& info = reader->info();
  EXPECT_TRUE(info.has_sidecar);
  EXPECT_THAT(info.notes, IsEmpty());
  EXPECT_EQ(info.rate_hz, 500.0);
  EXPECT_EQ(info.loaded.scene.name, "ten");
  EXPECT_THAT(info.loaded.changes, SizeIs(2));
  EXPECT_EQ(info.device, "simulator");
  EXPECT_EQ(info.realtime, "real-time priority 80");
  EXPECT_EQ(info.start_time, "2024-05-06T07:08:09Z");
  std::array<Tick, 10> read;
  ASSERT_EQ(*reader->read(0, read), 10U);
  std::vector<std::uint32_t> generations;
  for (const Tick& tick : read) generations.push_back(tick.x().generation);
  EXPECT_THAT(generations, ElementsAre(0, 0, 0, 1, 1, 2, 2, 2, 2, 2));
}

TEST_F(RecordingReading, RowsWithoutASidecarAreShown) {
  record(0, 10, csv_columns(true));
  fs::remove(path("a.toml"));
  const auto reader = opened();
  EXPECT_FALSE(reader->info().has_sidecar);
  EXPECT_THAT(reader->info().notes,
              ElementsAre(AllOf(HasSubstr("no sidecar"), HasSubstr("a.toml"))));
  EXPECT_EQ(reader->info().rate_hz, 1000.0);  // 9 / 0.009
  EXPECT_THAT(reader->info().loaded.scene.x().walls, IsEmpty());
  EXPECT_EQ(reader->info().loaded.scene.name, "a");
}

TEST_F(RecordingReading, AWrongSidecarIsSaidAndLeftOut) {
  record(0, 10, csv_columns(true));
  put("a.toml", "name = 3");
  EXPECT_THAT(opened()->info().notes, ElementsAre(HasSubstr("a.toml:1: name")));
  put("a.toml", "duration_s = 1.0\n[device]\nmass_kg = 0.05\ndamping_n_s_per_m = 1.0\n");
  const auto reader = opened();
  EXPECT_FALSE(reader->info().has_sidecar);
  EXPECT_THAT(reader->info().notes, ElementsAre(HasSubstr("not this recording's sidecar")));
}

TEST_F(RecordingReading, ACsvThatWasChangedIsSaid) {
  record(0, 10, csv_columns(true));
  std::string csv = content("a.csv");
  csv[csv.size() - 2] = csv[csv.size() - 2] == '1' ? '2' : '1';
  put("a.csv", csv);
  const auto reader = opened();
  EXPECT_TRUE(reader->info().has_sidecar);
  EXPECT_THAT(reader->info().notes, ElementsAre(HasSubstr("SHA-256 differs")));
}

TEST_F(RecordingReading, HolesAreForgivenWhereTheSidecarTellsOfThem) {
  std::mt19937_64 random(1);
  const std::string rows = row_of(random_sample(4, random)) + row_of(random_sample(8, random));
  put("a.csv", header() + rows);
  EXPECT_EQ(refusal(), "a.csv:3: tick 8 follows tick 4: 3 rows are missing");
  RecordingMetadata metadata;
  metadata.dropped_rows = 3;
  record(0, 1, csv_columns(true), metadata);
  put("a.csv", header() + rows);
  const auto reader = opened();
  EXPECT_EQ(reader->info().scanned.missing_rows, 3U);
  EXPECT_THAT(reader->info().notes, ::testing::Contains("incomplete: 3 rows are missing"));
  EXPECT_EQ(*reader->row_at(5), 1U);
}

TEST_F(RecordingReading, APartialFileIsReadUpToItsLastWholeLine) {
  record(0, 10, csv_columns(true));
  const std::string csv = content("a.csv");
  put("b.csv.partial", csv.substr(0, csv.size() - 40));
  put("b.toml", content("a.toml"));  // sidecar of an older b.csv, not of this one
  const auto reader = opened("b.csv.partial");
  EXPECT_EQ(reader->rows(), 9U);
  EXPECT_FALSE(reader->info().has_sidecar);
  EXPECT_THAT(reader->info().notes, ElementsAre(HasSubstr("never finished"),
                                                HasSubstr("no sidecar"), HasSubstr("cut off")));
  // The notes that were written during the recording count as its sidecar.
  put("b.toml.partial", content("a.toml"));
  EXPECT_TRUE(opened("b.csv.partial")->info().has_sidecar);
}

TEST_F(RecordingReading, RefusesAHeaderLongerThanAnyRecordingHas) {
  put("a.csv", std::string(5000, 'x'));
  EXPECT_THAT(refusal(), HasSubstr("a.csv:1: longer than 2048 bytes"));
}

TEST_F(RecordingReading, AFileThatShrinksIsFoundOut) {
  record(0, 3000, csv_columns(true));
  const auto reader = opened();
  fs::resize_file(path("a.csv"), 2000);
  std::array<Tick, 10> some;
  const auto read = reader->read(2500, some);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("a.csv: changed while it was read"));
}

TEST_F(RecordingReading, TheFirstPassCanBeEnded) {
  record(0, 10, csv_columns(true));
  double told = -1.0;
  const auto reader = RecordingReader::open(path("a.csv"), [&](double fraction) {
    told = fraction;
    return false;
  });
  ASSERT_FALSE(reader);
  EXPECT_THAT(reader.error().message, HasSubstr("ended early"));
  EXPECT_EQ(told, 1.0);
}

// However the bytes come in, the outcome is the same.
TEST(RecordingScanning, PiecesMayBeCutAnywhere) {
  std::mt19937_64 random(1);
  std::string text = csv_header(csv_columns(true)) + '\n';
  for (std::uint64_t tick = 5; tick < 8; ++tick) text += row_of(random_sample(tick, random));
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    RecordingScan scan("a.csv", {});
    ASSERT_FALSE(scan.take(std::string_view(text).substr(0, cut)));
    ASSERT_FALSE(scan.take(std::string_view(text).substr(cut)));
    const auto rows = scan.finish();
    ASSERT_TRUE(rows);
    EXPECT_EQ(rows->rows, 3U);
    EXPECT_EQ(rows->first_tick, 5U);
    EXPECT_EQ(rows->last_tick, 7U);
    EXPECT_EQ(rows->end_offset, text.size());
  }
}

}  // namespace
}  // namespace hapticwall::file
