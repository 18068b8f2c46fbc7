// `hand.path_file`: the path of a measured hand, in scenes, in --set and in sidecars.
#include "app/file/scene/hand_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/file/disk/sha256.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/recording/sidecar.h"
#include "app/file/scene/scene_file.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kHand = "time_s,position_m\n0,0.03\n0.5,0.06\n";

std::string scene_text(const std::string& hand) {
  return "[device]\nmass_kg = 0.05\ndamping_n_s_per_m = 1\n[hand]\nstiffness_n_per_m = 100\n" +
         hand;
}

class HandFile : public hapticwall::test::FolderTest {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(path("scenes/hands"));
    put("scenes/hands/hand.csv", kHand);
    put("scenes/a.toml", scene_text("path_file = \"hands/hand.csv\"\n"));
  }
  [[nodiscard]] LoadedScene load(const std::string& name) const {
    Result<LoadedScene> loaded = load_scene(path(name));
    if (!loaded) throw std::runtime_error(loaded.error().message);
    return std::move(*loaded);
  }
};

TEST_F(HandFile, IsBesideItsScene) {
  const SharedPath hand = load("scenes/a.toml").scene.x().hand->path;
  EXPECT_EQ(hand, (SharedPath{{0.0, 0.03}, {0.5, 0.06}}));
  EXPECT_EQ(hand.file, path("scenes/hands/hand.csv"));
  EXPECT_EQ(hand.sha256, sha256_of(path("scenes/hands/hand.csv"), std::string(kHand).size()));
}

TEST_F(HandFile, OfSetIsInTheCurrentFolderAndReplacesThePath) {
  const std::string before = std::filesystem::current_path().string();
  std::filesystem::current_path(path("scenes/hands"));
  const std::vector<std::string> file{"hand.path_file=hand.csv"};
  const Result<LoadedScene> points = load_scene("press", file);
  const std::vector<std::string> both{"hand.path_file=hand.csv", "hand.path=[[0, 0.01]]"};
  const Result<LoadedScene> last = load_scene(path("scenes/a.toml"), both);
  std::filesystem::current_path(before);
  ASSERT_TRUE(points) << points.error().message;
  EXPECT_EQ(points->scene.x().hand->path, (SharedPath{{0.0, 0.03}, {0.5, 0.06}}));
  ASSERT_TRUE(last) << last.error().message;
  EXPECT_EQ(last->scene.x().hand->path, (SharedPath{{0.0, 0.01}}));
  EXPECT_EQ(last->scene.x().hand->path.file, "");
}

TEST_F(HandFile, ASidecarNamesItFromItsOwnFolder) {
  const Scene scene = load("scenes/a.toml").scene;
  std::filesystem::create_directory(path("out"));
  put("out/b.toml", sidecar_toml(beside(scene, path("out/b.csv")), {}, {8, 0, 8, "0"}));
  EXPECT_THAT(content("out/b.toml"), HasSubstr("path_file = \"../scenes/hands/hand.csv\"\n"));
  EXPECT_THAT(content("out/b.toml"), HasSubstr("path_sha256 = \"" + scene.x().hand->path.sha256));
  EXPECT_THAT(content("out/b.toml"), Not(HasSubstr("path = ")));
  const LoadedScene again = load("out/b.toml");
  EXPECT_EQ(again.scene.x().hand, scene.x().hand);
  EXPECT_EQ(again.not_repeatable_because, "");
}

TEST_F(HandFile, WithOtherBytesTheSessionCannotBeRepeated) {
  put("scenes/b.toml",
      sidecar_toml(beside(load("scenes/a.toml").scene, path("scenes/b.csv")), {}, {8, 0, 8, "0"}));
  put("scenes/hands/hand.csv", std::string(kHand) + "0.6,0.06\n");
  EXPECT_THAT(load("scenes/b.toml").not_repeatable_because,
              EndsWith("hand.csv was changed since (SHA-256 differs)"));
  EXPECT_EQ(load("scenes/a.toml").not_repeatable_because, "");
}

// A window may edit the points.
TEST_F(HandFile, EditedPointsAreNoFilesAnyMore) {
  Scene scene = load("scenes/a.toml").scene;
  const Scene copy = scene;  // NOLINT(performance-unnecessary-copy-initialization)
  scene.x().hand->path.edit().back().position_m = 0.07;
  EXPECT_EQ(copy.x().hand->path.back().position_m, 0.06);
  EXPECT_THAT(scene_to_toml(scene), HasSubstr("path = [[0.0, 0.03], [0.5, 0.07]]"));
}

TEST_F(HandFile, HasAsManyPointsAsItLikes) {
  std::string text(kHandHeader);
  constexpr int kPoints = 60'000;
  for (int i = 0; i < kPoints; ++i) text += "\n" + std::to_string(i) + "e-3,0.05";
  put("scenes/hands/hand.csv", text);
  const Scene scene = load("scenes/a.toml").scene;
  ASSERT_EQ(scene.x().hand->path.size(), 60'000U);
  EXPECT_EQ(scene.x().hand->path.back(), (PathPoint{59.999, 0.05}));
  const Scene copy = scene;  // NOLINT(performance-unnecessary-copy-initialization)
  EXPECT_EQ(&copy.x().hand->path.front(), &scene.x().hand->path.front()) << "copies share them";
}

TEST_F(HandFile, MayBeginWithAByteOrderMark) {
  put("scenes/hands/hand.csv", std::string("\xEF\xBB\xBF") + kHand);
  EXPECT_EQ(load("scenes/a.toml").scene.x().hand->path, (SharedPath{{0.0, 0.03}, {0.5, 0.06}}));
}

TEST_F(HandFile, OtherColumnsAreSkipped) {
  const auto hand =
      parse_hand("frame,position_m, force_n ,time_s\n1,0.03,2.5,0\n2,0.06,\"x\",0.5\n", "hand.csv");
  ASSERT_TRUE(hand) << hand.error().message;
  EXPECT_EQ(*hand, (std::vector<PathPoint>{{0.0, 0.03}, {0.5, 0.06}}));
}

TEST_F(HandFile, AClockMayStartAnywhere) {
  for (const char* text : {"time_s,position_m\n1764115200,0.03\n1764115200.5,0.06\n",
                           "time_s,position_m\n-3,0.03\n-2.5,0.06\n"}) {
    const auto hand = parse_hand(text, "hand.csv");
    ASSERT_TRUE(hand) << hand.error().message;
    EXPECT_EQ(*hand, (std::vector<PathPoint>{{0.0, 0.03}, {0.5, 0.06}}));
  }
  EXPECT_EQ(parse_hand("time_s,position_m\n0.25,0.03\n", "")->front().time_s, 0.25)
      << "a wait before the motion stays";
}

// The writer of a scene could name a file of its reader, and see its lines in a report of the
// error.
TEST_F(HandFile, AMessageTellsNoTextOfTheFile) {
  const std::string secret = "root:$y$j9T$secret";
  for (const std::string& text :
       {secret + ":1\n", "time_s,position_m\n" + secret + "\n",
        "time_s,position_m\n" + secret + ",1\n", "time_s,position_m\n1," + secret + "\n"}) {
    const Result<std::vector<PathPoint>> hand = parse_hand(text, "hand.csv");
    ASSERT_FALSE(hand) << text;
    EXPECT_THAT(hand.error().message, Not(HasSubstr("secret")));
    EXPECT_THAT(hand.error().message, Not(HasSubstr("root")));
  }
}

TEST_F(HandFile, OfTheKernelIsRefused) {
  for (const std::string file : {"/proc/self/status", "/sys/kernel/mm/ksm/run"}) {
    if (!std::filesystem::exists(file)) continue;
    const Result<SharedPath> hand = read_hand_file(file);
    ASSERT_FALSE(hand);
    EXPECT_EQ(hand.error().message, file + ": not a hand: a file of the kernel");
  }
}

TEST_F(HandFile, TooLargeIsRefused) {
  std::filesystem::resize_file(path("scenes/hands/hand.csv"), kMaxHandBytes + 1);
  const Result<SharedPath> hand = read_hand_file(path("scenes/hands/hand.csv"));
  ASSERT_FALSE(hand);
  EXPECT_THAT(hand.error().message, EndsWith("not a hand: larger than 67108864 bytes"));
}

}  // namespace
}  // namespace hapticwall::file::test
