// --set KEY=VALUE on a scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::file {
namespace {

using ::testing::StartsWith;

constexpr const char* kOneWall = R"(
[device]
mass_kg = 0.05
damping_n_s_per_m = 1
[[wall]]
position_m = 0.05
stiffness_n_per_m = 35000
)";
constexpr const char* kTwoWalls = R"(
[device]
mass_kg = 0.05
damping_n_s_per_m = 1
[[wall]]
position_m = 0.05
stiffness_n_per_m = 1000
[[wall]]
position_m = 0.06
stiffness_n_per_m = 2000
)";

Scene changed(const std::string& text, const std::vector<std::string>& overrides) {
  const Result<LoadedScene> loaded = parse_scene(text, "x.toml", overrides);
  EXPECT_TRUE(loaded) << loaded.error().message;
  return loaded ? loaded->scene : Scene{};
}

std::string override_message(const std::string& text, const std::string& override_text) {
  const std::vector<std::string> overrides{override_text};
  const Result<LoadedScene> loaded = parse_scene(text, "x.toml", overrides);
  if (loaded) return "(no error)";
  EXPECT_EQ(loaded.error().kind, ErrorKind::kUsage);
  return loaded.error().message;
}

TEST(Override, ReplacesAndAdds) {
  const Scene scene = changed(kOneWall, {"device.mass_kg=0.2", "device.encoder_m = 1e-4",
                                         "sampling.rate_hz=500", "name=two words"});
  EXPECT_EQ(scene.x().device.mass_kg, 0.2);
  EXPECT_EQ(scene.x().device.encoder_m, 1e-4);
  EXPECT_EQ(scene.sampling.rate_hz, 500.0);
  EXPECT_EQ(scene.name, "two words");
}

TEST(Override, TheLastOneCounts) {
  EXPECT_EQ(changed(kOneWall, {"duration_s=1", "duration_s=2"}).duration_s, 2.0);
}

TEST(Override, BareWordsAreStrings) {
  EXPECT_EQ(changed(kOneWall, {"algorithm.name=energy-bounding"}).algorithm.index,
            find_algorithm("energy-bounding"));
  EXPECT_EQ(changed(kOneWall, {"algorithm.name=\"none\""}).algorithm.index, find_algorithm("none"));
  EXPECT_TRUE(changed(kOneWall, {"hand.path=mouse"}).x().hand->follows_mouse);
}

TEST(Override, WholeTablesAndPaths) {
  const Scene scene =
      changed(kOneWall, {"hand.path=[[0, 0.03], [1, 0.06]]", "hand.stiffness_n_per_m=300"});
  ASSERT_TRUE(scene.x().hand);
  EXPECT_EQ(scene.x().hand->path, (std::vector<PathPoint>{{0.0, 0.03}, {1.0, 0.06}}));
  EXPECT_TRUE(changed(kOneWall, {"wall=[]"}).x().walls.empty());
}

TEST(Override, Walls) {
  EXPECT_EQ(changed(kOneWall, {"wall.stiffness_n_per_m=7"}).x().walls[0].stiffness_n_per_m, 7.0);
  EXPECT_EQ(changed(kOneWall, {"wall[0].damping_n_s_per_m=7"}).x().walls[0].damping_n_s_per_m, 7.0);
  const Scene scene = changed(kTwoWalls, {"wall[1].stiffness_n_per_m=7"});
  EXPECT_EQ(scene.x().walls[0].stiffness_n_per_m, 1000.0);
  EXPECT_EQ(scene.x().walls[1].stiffness_n_per_m, 7.0);
  EXPECT_EQ(
      override_message(kTwoWalls, "wall.stiffness_n_per_m=7"),
      "--set wall.stiffness_n_per_m=7: the scene has 2 walls; say which: wall[0] ... wall[1]");
  EXPECT_EQ(
      override_message(kTwoWalls, "wall[2].stiffness_n_per_m=7"),
      "--set wall[2].stiffness_n_per_m=7: wall[2] does not exist; walls of the scene: 2, counted "
      "from wall[0]");
  EXPECT_EQ(override_message("[device]\nmass_kg=1\n", "wall.damping_n_s_per_m=7"),
            "--set wall.damping_n_s_per_m=7: the scene has no wall");
}

TEST(Override, NonsenseGetsOneLineThatNamesIt) {
  EXPECT_EQ(override_message(kOneWall, "nonsense"),
            "--set nonsense: there is no '=': it takes KEY=VALUE");
  EXPECT_EQ(override_message(kOneWall, "a="), "--set a=: there is no value: it takes KEY=VALUE");
  EXPECT_EQ(override_message(kOneWall, "foo=1"),
            "--set foo=1: foo: unknown key; known here: name, description, duration_s, sampling, "
            "device, hand, wall, algorithm, simulator, recording, map");
  EXPECT_EQ(override_message(kOneWall, "device.masskg=1"),
            "--set device.masskg=1: device.masskg: unknown key; did you mean 'mass_kg'?");
  EXPECT_EQ(override_message(kOneWall, "device.mass_kg=heavy"),
            "--set device.mass_kg=heavy: device.mass_kg: the string 'heavy' where a number in kg "
            "belongs");
  EXPECT_EQ(override_message(kOneWall, "device.mass_kg=nan"),
            "--set device.mass_kg=nan: device.mass_kg: nan is not a finite number");
  EXPECT_THAT(override_message(kOneWall, "device.mass_kg=-1"),
              StartsWith("--set device.mass_kg=-1: device.mass_kg: -1 is out of range"));
  EXPECT_EQ(override_message(kOneWall, "duration_s.x=1"),
            "--set duration_s.x=1: duration_s: a table where a number in s belongs");
  EXPECT_EQ(override_message(kOneWall, "device.mass_kg.x=1"),
            "--set device.mass_kg.x=1: mass_kg is not a table");
  for (const char* key : {"", ".", "a..b", "a b", "a[", "a[1", "a[1]b", "a[-1]", "[0]", "\"a\""}) {
    EXPECT_THAT(override_message(kOneWall, std::string(key) + "=1"),
                StartsWith("--set " + std::string(key) + "=1: the key is not"));
  }
  EXPECT_THAT(override_message(kOneWall, "hand[0].mass_kg=1"),
              StartsWith("--set hand[0].mass_kg=1: only wall.KEY takes an index"));
  EXPECT_THAT(override_message(kOneWall, "hand.path=[[0"),
              StartsWith("--set hand.path=[[0: the value is not TOML"));
}

// A value cannot contain a second key.
TEST(Override, ValuesWithLineEndsAreRefused) {
  EXPECT_EQ(override_message(kOneWall, "duration_s=1\nname='x'"),
            "--set duration_s=1?name='x': the value is not one line of TOML");
}

TEST(Override, LongTextIsCutInMessages) {
  const std::string text = override_message(kOneWall, "name=[" + std::string(100'000, 'x'));
  EXPECT_LT(text.size(), 300U);
}

}  // namespace
}  // namespace hapticwall::file
