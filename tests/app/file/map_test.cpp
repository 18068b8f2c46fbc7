// The CSV of a map: rows, parts, and a resumed run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

#include "app/file/map/map_file.h"
#include "app/file/map/map_rows.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/file/faulty_disk.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file {
namespace {

using test::FaultyDisk;
using ::testing::HasSubstr;

StabilityMap small_map() {
  StabilityMap map;
  map.scene = load_scene("golden-soft")->scene;
  map.scene.duration_s = 1.2;
  map.algorithms = {find_algorithm("none").value(), find_algorithm("half-sample").value()};
  map.x = {find_scene_number(map.scene, "wall.stiffness_n_per_m").value(), 100.0, 3000.0, 4, true};
  map.y = {find_scene_number(map.scene, "device.damping_n_s_per_m").value(), 0.1, 0.7, 3, false};
  return map;
}

class MapFile : public hapticwall::test::FolderTest {
 protected:
  // Cells [begin, end) of a part; without finish() where `whole` is false.
  void write(const std::string& name, const MapPart& part, std::size_t end, bool whole) const {
    auto writer = MapWriter::open(path(name), map_, part);
    ASSERT_TRUE(writer.ok()) << writer.error().message;
    const std::size_t begin = part.begin + writer->found().size();
    ASSERT_FALSE(writer->append(map_, begin, run_cells(map_, begin, end)));
    if (whole) ASSERT_FALSE(writer->finish());
  }

  StabilityMap map_ = small_map();
};

TEST_F(MapFile, ARowIsReadBackAsItWas) {
  MapMetrics figures;
  figures.verdict = Verdict::kOscillating;
  figures.tail_peak_to_peak_m = 0.1 + 0.2;
  figures.max_penetration_m = 1e-300;
  std::string line;
  append_map_row(line, map_, 7, figures);
  EXPECT_EQ(line, "none,3000,0.4,oscillating,0.30000000000000004,,,,1e-300,\n");
  line.pop_back();
  const auto back = parse_map_row(line, map_, 7);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, figures);
}

TEST_F(MapFile, ARowOfAnotherCellOrSpoiltIsNone) {
  std::string line;
  append_map_row(line, map_, 7, {});
  line.pop_back();
  EXPECT_TRUE(parse_map_row(line, map_, 7));
  EXPECT_FALSE(parse_map_row(line, map_, 6));
  EXPECT_FALSE(parse_map_row(line, map_, 3)) << "as long a line, of another y";
  EXPECT_FALSE(parse_map_row(line, map_, 7 + 12)) << "the other algorithm";
  EXPECT_FALSE(parse_map_row(line + ",", map_, 7));
  EXPECT_FALSE(parse_map_row(line + "x", map_, 7));
  EXPECT_FALSE(parse_map_row(line + "nan", map_, 7));
  EXPECT_FALSE(parse_map_row(line.substr(0, line.size() - 1), map_, 7));
  EXPECT_FALSE(parse_map_row("", map_, 7));
}

// A CSV of a version that called an algorithm otherwise.
TEST_F(MapFile, ARowMayHaveTheOldNameOfItsAlgorithm) {
  map_.algorithms = {find_algorithm("energy-bookkeeping").value()};
  std::string line;
  append_map_row(line, map_, 7, {});
  line.pop_back();
  EXPECT_TRUE(line.starts_with("energy-limited-spring,"));
  const std::string old = "energy-bookkeeping" + line.substr(line.find(','));
  EXPECT_TRUE(parse_map_row(old, map_, 7));
  EXPECT_FALSE(parse_map_row(old, map_, 6));
  map_.algorithms = {find_algorithm("none").value()};
  EXPECT_FALSE(parse_map_row(old, map_, 7));
}

TEST_F(MapFile, PartsInARowAreTheWholeByteForByte) {
  write("whole.csv", map_part(map_, 1, 1), map_.cell_count(), true);
  const std::string whole = content("whole.csv");
  EXPECT_EQ(std::count(whole.begin(), whole.end(), '\n'), 25);
  for (const std::size_t parts : {2U, 5U, 7U, 24U}) {
    std::string together;
    for (std::size_t i = 1; i <= parts; ++i) {
      const MapPart part = map_part(map_, i, parts);
      write("part.csv", part, part.end, true);
      together += content("part.csv");
    }
    EXPECT_EQ(together, whole) << parts;
  }
}

TEST_F(MapFile, ARunGoesOnWhereAnotherOneStopped) {
  const MapPart all = map_part(map_, 1, 1);
  write("whole.csv", all, all.end, true);
  write("map.csv", all, 10, false);
  EXPECT_FALSE(std::filesystem::exists(path("map.csv")));
  // A kill in the middle of a line.
  const std::string partial = content("map.csv.partial");
  put("map.csv.partial", partial.substr(0, partial.size() - 5));
  auto writer = MapWriter::open(path("map.csv"), map_, all);
  ASSERT_TRUE(writer.ok()) << writer.error().message;
  EXPECT_EQ(writer->found(), run_cells(map_, 0, 9));
  ASSERT_FALSE(writer->append(map_, 9, run_cells(map_, 9, all.end)));
  ASSERT_FALSE(writer->finish());
  EXPECT_EQ(content("map.csv"), content("whole.csv"));
  EXPECT_EQ(content("map.toml"), content("whole.toml"));
  EXPECT_FALSE(std::filesystem::exists(path("map.csv.partial")));
  EXPECT_FALSE(std::filesystem::exists(path("map.toml.partial")));
}

TEST_F(MapFile, ARunThatEndedBetweenItsTwoNamesIsFinished) {
  const MapPart all = map_part(map_, 1, 1);
  write("map.csv", all, all.end, true);
  const std::string whole = content("map.csv");
  std::filesystem::rename(path("map.csv"), path("map.csv.partial"));
  auto writer = MapWriter::open(path("map.csv"), map_, all);
  ASSERT_TRUE(writer.ok()) << writer.error().message;
  EXPECT_EQ(writer->found().size(), map_.cell_count());
  ASSERT_FALSE(writer->finish());
  EXPECT_EQ(content("map.csv"), whole);
}

TEST_F(MapFile, RowsOfAnotherMapAreNotOverwritten) {
  const MapPart all = map_part(map_, 1, 1);
  write("map.csv", all, 10, false);
  const std::string partial = content("map.csv.partial");
  map_.scene.x().device.mass_kg *= 2.0;
  const auto writer = MapWriter::open(path("map.csv"), map_, all);
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(writer.error().kind, ErrorKind::kFile);
  EXPECT_THAT(writer.error().message, HasSubstr("map.csv.partial: it belongs to another map"));
  EXPECT_EQ(content("map.csv.partial"), partial);
}

// A finished map does not identify the rows of a later one of the same name.
TEST_F(MapFile, RowsOfAnotherMapUnderAFinishedOneAreNotTaken) {
  const MapPart all = map_part(map_, 1, 1);
  write("map.csv", all, all.end, true);
  const StabilityMap finished = map_;
  map_.scene.x().device.mass_kg *= 2.0;
  write("map.csv", all, 5, false);
  const std::string partial = content("map.csv.partial");
  {
    const auto writer = MapWriter::open(path("map.csv"), finished, all);
    ASSERT_FALSE(writer.ok());
    EXPECT_THAT(writer.error().message, HasSubstr(": it belongs to another map"));
  }
  EXPECT_EQ(content("map.csv.partial"), partial);
  const auto writer = MapWriter::open(path("map.csv"), map_, all);
  ASSERT_TRUE(writer.ok()) << writer.error().message;
  EXPECT_EQ(writer->found().size(), 5U);
}

// Resuming on a full disk changes nothing.
TEST_F(MapFile, AFullDiskCostsNoMapThatWasBegun) {
  const MapPart all = map_part(map_, 1, 1);
  write("map.csv", all, 10, false);
  const std::string sidecar = content("map.toml.partial");
  const std::vector<MapMetrics> next = run_cells(map_, 10, 11);
  {
    FaultyDisk disk;
    disk.fail_after(0, ENOSPC);
    auto writer = MapWriter::open(path("map.csv"), map_, all);
    ASSERT_TRUE(writer.ok()) << writer.error().message;
    EXPECT_TRUE(writer->append(map_, 10, next));
  }
  EXPECT_EQ(content("map.toml.partial"), sidecar);
  const auto writer = MapWriter::open(path("map.csv"), map_, all);
  ASSERT_TRUE(writer.ok()) << writer.error().message;
  EXPECT_EQ(writer->found().size(), 10U);
}

TEST_F(MapFile, AFullDiskBetweenTheTwoNamesCostsNoMapEither) {
  const MapPart all = map_part(map_, 1, 1);
  write("map.csv", all, all.end, true);
  std::filesystem::rename(path("map.csv"), path("map.csv.partial"));
  for (const std::size_t room : {0U, 10U}) {
    FaultyDisk disk;
    disk.fail_after(room, ENOSPC);
    const auto writer = MapWriter::open(path("map.csv"), map_, all);
    ASSERT_FALSE(writer.ok());
    EXPECT_THAT(writer.error().message, HasSubstr("could not be written: No space left"));
  }
  put("map.toml.partial", "");  // a kill before its first byte
  const auto writer = MapWriter::open(path("map.csv"), map_, all);
  ASSERT_TRUE(writer.ok()) << writer.error().message;
  EXPECT_EQ(writer->found().size(), map_.cell_count());
}

TEST_F(MapFile, ASceneOfTheSameNameIsNotWrittenOver) {
  put("map.toml", "name = \"mine\"\n");
  const auto writer = MapWriter::open(path("map.csv"), map_, map_part(map_, 1, 1));
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(content("map.toml"), "name = \"mine\"\n");
}

TEST_F(MapFile, TheSidecarIsTheScene) {
  write("map.csv", map_part(map_, 1, 1), map_.cell_count(), true);
  const auto loaded = load_scene(path("map.toml"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(scene_to_toml(loaded->scene), scene_to_toml(map_.scene));
  EXPECT_THAT(content("map.toml"), HasSubstr("x = \"wall.stiffness_n_per_m=100:3000:4:log\""));
}

TEST_F(MapFile, AWholeMapIsReadAndAnythingElseIsNot) {
  write("map.csv", map_part(map_, 1, 1), map_.cell_count(), true);
  const auto figures = read_map(path("map.csv"), map_);
  ASSERT_TRUE(figures.ok()) << figures.error().message;
  EXPECT_EQ(*figures, run_cells(map_, 0, map_.cell_count()));
  const auto refusal = [&](const std::string& text) {
    put("wrong.csv", text);
    const auto read = read_map(path("wrong.csv"), map_);
    return read.ok() ? std::string() : read.error().message.substr(path("").size());
  };
  const std::string text = content("map.csv");
  EXPECT_THAT(refusal(""), HasSubstr("wrong.csv: not a map: empty"));
  EXPECT_THAT(refusal("a,b\n"), HasSubstr("wrong.csv:1: not the header of this map: algorithm,"));
  EXPECT_THAT(refusal(text.substr(0, text.size() - 1)),
              HasSubstr("wrong.csv:25: not cell 24 of the 24 of this map"));
  EXPECT_THAT(refusal(text + "x"), HasSubstr("wrong.csv:26: unexpected text after the last cell"));
  std::string swapped = text;
  swapped.replace(swapped.find("none"), 4, "nine");
  EXPECT_THAT(refusal(swapped), HasSubstr("wrong.csv:2: not cell 1 of the 24"));
}

}  // namespace
}  // namespace hapticwall::file
