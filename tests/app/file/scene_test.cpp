// Scene files: parsing, and one-line messages for errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::file {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kWholeScene = R"(name = "whole"
description = "every key that there is"
duration_s = 2
[sampling]
rate_hz = 2000
[device]
mass_kg = 0.05
damping_n_s_per_m = 1
friction_n = 0.14
encoder_m = 0.254e-3
force_limit_n = 8.9
start_m = 0.02
[hand]
mass_kg = 0.4
stiffness_n_per_m = 250
damping_n_s_per_m = 33
grip_stiffness_n_per_m = 1000
grip_damping_n_s_per_m = 1
path = [[0, 0.03], [1.5, 0.075]]
[[wall]]
position_m = 0.05
stiffness_n_per_m = 35000
damping_n_s_per_m = 2
axis = "x"
[[wall]]
position_m = 0.06
stiffness_n_per_m = 1e5
[algorithm]
name = "passivity-control"
damping_n_s_per_m = 0.9
observer = "held-force"
damping_credit = true
[simulator]
integrator = "exact"
substeps = 1
)";

std::string scene_message(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Result<LoadedScene> loaded = parse_scene(text, "x.toml", overrides);
  if (loaded) return "(no error)";
  EXPECT_EQ(loaded.error().kind, ErrorKind::kUsage);
  EXPECT_EQ(loaded.error().message.find('\n'), std::string::npos) << loaded.error().message;
  return loaded.error().message;
}

std::string scene_with(const std::string& what, const std::string& by) {
  std::string text = kWholeScene;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(SceneFile, ReadsEveryKey) {
  const Result<LoadedScene> loaded = parse_scene(kWholeScene, "x.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  const Scene& scene = loaded->scene;
  EXPECT_EQ(scene.name, "whole");
  EXPECT_EQ(scene.description, "every key that there is");
  EXPECT_EQ(scene.duration_s, 2.0);
  EXPECT_EQ(scene.sampling.rate_hz, 2000.0);
  EXPECT_EQ(scene.x().device.mass_kg, 0.05);
  EXPECT_EQ(scene.x().device.encoder_m, 0.254e-3);
  EXPECT_EQ(scene.x().device.start_m, 0.02);
  ASSERT_TRUE(scene.x().hand);
  EXPECT_EQ(scene.x().hand->grip_damping_n_s_per_m, 1.0);
  EXPECT_EQ(scene.x().hand->path, (SharedPath{{0.0, 0.03}, {1.5, 0.075}}));
  ASSERT_EQ(scene.x().walls.size(), 2U);
  EXPECT_EQ(scene.x().walls[0].damping_n_s_per_m, 2.0);
  EXPECT_EQ(scene.x().walls[1].damping_n_s_per_m, 0.0);
  EXPECT_EQ(scene.algorithm.index, find_algorithm("passivity-control"));
  const auto value = [&](const char* key) {
    return scene.algorithm.values.at(find_algorithm_parameter(key).value());
  };
  EXPECT_EQ(value("damping_n_s_per_m"), 0.9);
  EXPECT_EQ(value("damping_credit"), 1.0);
  const ParameterDescription& observer =
      algorithm_parameters()[find_algorithm_parameter("observer").value()];
  EXPECT_EQ(observer.choices[static_cast<std::size_t>(value("observer").value())], "held-force");
  EXPECT_FALSE(value("rest_force_step_n").has_value());
}

TEST(SceneFile, AbsentValuesAreLeftOut) {
  const Result<LoadedScene> loaded =
      parse_scene("[device]\nmass_kg = 1\ndamping_n_s_per_m = 0\n", "dir/bare.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.name, "bare");
  EXPECT_FALSE(loaded->scene.x().device.friction_n || loaded->scene.x().device.encoder_m ||
               loaded->scene.x().device.force_limit_n || loaded->scene.x().hand);
  EXPECT_TRUE(loaded->scene.x().walls.empty());
  EXPECT_EQ(loaded->scene.algorithm.index, find_algorithm("none"));
}

TEST(SceneFile, NamesNoEstimatorThatIsTheDefault) {
  const auto loaded = parse_scene(
      scene_with("[simulator]", "[estimator]\nname = \"backward-difference\"\n[simulator]"),
      "x.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene, parse_scene(kWholeScene, "x.toml")->scene);
  EXPECT_EQ(scene_to_toml(loaded->scene).find("estimator"), std::string::npos);
}

TEST(SceneFile, MouseAsHand) {
  const auto loaded = parse_scene(scene_with("[[0, 0.03], [1.5, 0.075]]", "\"mouse\""), "x.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->scene.x().hand->follows_mouse);
}

// The whole scene with a second axis; its walls come before, between and after those of the first.
std::string corner() {
  return scene_with("[hand]\n", R"([device.y]
mass_kg = 0.1
damping_n_s_per_m = 2
start_m = 0.01
[hand.y]
stiffness_n_per_m = 100
damping_n_s_per_m = 3
path = [[0, 0.01], [1, 0.06]]
[[wall]]
axis = "y"
position_m = 0.055
stiffness_n_per_m = 700
[hand]
)") + R"([[wall]]
axis = "y"
position_m = 0.056
stiffness_n_per_m = 800
)";
}

TEST(SceneFile, ASecondAxisHasItsOwnDeviceHandAndWalls) {
  const auto loaded = parse_scene(corner(), "x.toml");
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Scene& scene = loaded->scene;
  ASSERT_TRUE(scene.two_axes());
  EXPECT_EQ(scene.x().walls.size(), 2U);
  EXPECT_EQ(scene.x().device.mass_kg, 0.05);
  EXPECT_EQ(scene.axes[1].device.mass_kg, 0.1);
  EXPECT_EQ(scene.axes[1].device.friction_n, std::nullopt) << "nothing is taken over from axis x";
  ASSERT_TRUE(scene.axes[1].hand.has_value());
  EXPECT_EQ(scene.axes[1].hand->path.back(), (PathPoint{1.0, 0.06}));
  EXPECT_EQ(scene.axes[1].walls,
            (std::vector<WallSettings>{{0.055, 700.0, 0.0}, {0.056, 800.0, 0.0}}));
  const Scene axis = axis_scene(scene, 1);
  EXPECT_EQ(axis.axes, std::vector{scene.axes[1]});
  EXPECT_EQ(axis.algorithm, scene.algorithm);
  EXPECT_EQ(axis.sampling.rate_hz, 2000.0);
}

TEST(SceneFile, ASecondAxisSurvivesTheWayThroughAFile) {
  const auto first = parse_scene(corner(), "x.toml");
  ASSERT_TRUE(first.ok());
  const std::string text = scene_to_toml(first->scene);
  const auto second = parse_scene(text, "x.toml");
  ASSERT_TRUE(second.ok()) << second.error().message;
  EXPECT_EQ(second->scene, first->scene);
  EXPECT_EQ(scene_to_toml(second->scene), text);
}

TEST(SceneFile, AHandMayBeOnTheSecondAxisOnly) {
  const auto loaded = parse_scene(
      "[device]\nmass_kg = 1\ndamping_n_s_per_m = 1\nstart_m = 0\n"
      "[device.y]\nmass_kg = 1\ndamping_n_s_per_m = 1\nstart_m = 0\n"
      "[hand.y]\nstiffness_n_per_m = 100\ndamping_n_s_per_m = 3\npath = [[0, 0]]\n",
      "x.toml");
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_FALSE(loaded->scene.x().hand.has_value());
  ASSERT_TRUE(loaded->scene.axes[1].hand.has_value());
  const auto again = parse_scene(scene_to_toml(loaded->scene), "x.toml");
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_FALSE(again->scene.x().hand.has_value());
  EXPECT_EQ(again->scene.axes, loaded->scene.axes);
}

// The message counts the walls as the file does, where a wall of axis y comes first.
TEST(SceneFile, NamesAWallByItsPlaceInTheFile) {
  for (const char* wall : {"wall[0]", "wall[1]", "wall[3]"}) {
    EXPECT_THAT(scene_message(corner(), {std::string(wall) + ".stiffness_n_per_m=-1"}),
                HasSubstr(std::string(wall) + ".stiffness_n_per_m: -1 is out of range"));
  }
}

TEST(SceneFile, ReadsDelayResolutionAndLag) {
  const auto loaded = parse_scene(
      scene_with("start_m = 0.02",
                 "delay_ticks = 3\nforce_resolution_n = 0.01\namplifier_time_constant_s = 2e-3"),
      "x.toml");
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(loaded->scene.x().device.delay_ticks, 3);
  EXPECT_EQ(loaded->scene.x().device.force_resolution_n, 0.01);
  EXPECT_EQ(loaded->scene.x().device.amplifier_time_constant_s, 2e-3);
}

TEST(SceneFile, ReadsTheIntegrator) {
  const auto loaded = parse_scene(scene_with("\"exact\"", "\"rk4\""), "x.toml");
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(loaded->scene.simulator.integrator, Integrator::kRungeKutta4);
}

// Inputs that overflowed the stack of some TOML parser.
TEST(SceneFile, SurvivesDeepNesting) {
  constexpr std::size_t kDepth = 200'000;
  std::string dotted = "a";
  std::string quoted = "\"a,\"";
  std::string tables = "a = ";
  for (std::size_t i = 0; i < kDepth; ++i) {
    dotted += ".a";
    quoted += ".\",\"";
    tables += "{a=";
  }
  EXPECT_THAT(scene_message(dotted + " = 1\n"),
              StartsWith("x.toml: not a scene: keys of more than"));
  EXPECT_THAT(scene_message(quoted + " = 1\n"),
              StartsWith("x.toml: not a scene: keys of more than"));
  EXPECT_THAT(scene_message("[" + dotted + "]\n"),
              StartsWith("x.toml: not a scene: keys of more than"));
  EXPECT_THAT(scene_message("x = '''\n#'''\n" + dotted + " = 1\n"),
              StartsWith("x.toml: not a scene: keys of more than"));
  EXPECT_THAT(scene_message("a = " + std::string(kDepth, '[')),
              StartsWith("x.toml:1: not valid TOML"));
  EXPECT_THAT(scene_message(tables), StartsWith("x.toml: not a scene: more than 10000 changes"));
  EXPECT_THAT(scene_message(tables.substr(0, 30'000)), StartsWith("x.toml:1: not valid TOML"));
}

TEST(SceneFile, DecimalPointsAreNotNesting) {
  std::string path;
  for (int i = 1; i <= 500; ++i) path += "[" + std::to_string(i) + ".5, 0.03],\n";
  EXPECT_EQ(scene_message(scene_with("[[0, 0.03], [1.5, 0.075]]", "[" + path + "]")), "(no error)");
}

TEST(SceneFile, PointsInTextAreNotNesting) {
  const std::string points(200, '.');
  EXPECT_EQ(scene_message(scene_with("every key", "see " + points + "= that, every key")),
            "(no error)");
  EXPECT_EQ(scene_message("# a" + points + " = b.c\n" + kWholeScene), "(no error)");
}

TEST(SceneFile, QuotesUserTextShortAndClean) {
  const std::string text =
      scene_message("name = 3\n[device]\n\"k\\u001b[31m" + std::string(5000, 'x') + "\" = 1\n");
  EXPECT_LT(text.size(), 400U) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(SceneFile, BuiltinScenesAreAllThereAndNamedAsTheirFiles) {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    names.push_back(scene.name);
    const Result<LoadedScene> loaded = load_scene(scene.name);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene.name, scene.name);
    EXPECT_EQ(loaded->scene.description, scene.description);
    EXPECT_FALSE(scene.description.empty());
  }
  EXPECT_THAT(names, ::testing::UnorderedElementsAre(
                         "press", "tap", "tap-slow", "light", "corner", "layers", "golden-soft",
                         "golden-hard", "golden-soft-fric", "tissue", "detents", "mass", "bump"));
}

// docs/physics.md gives the rates at which the paths rise.
TEST(SceneFile, BuiltinPathsRiseAtTheirRates) {
  const std::vector<std::tuple<std::string, double, double>> paths{{"press", 0.03, 0.075},
                                                                   {"tap", 0.2, 0.0653},
                                                                   {"tap-slow", 0.03, 0.0653},
                                                                   {"light", 0.1, 0.06}};
  for (const auto& [name, rate_m_per_s, end_m] : paths) {
    const Result<LoadedScene> loaded = load_scene(name);
    ASSERT_TRUE(loaded);
    const SharedPath& path = loaded->scene.x().hand->path;
    ASSERT_EQ(path.size(), 2U);
    EXPECT_EQ(path[0], (PathPoint{0.0, 0.03}));
    EXPECT_EQ(path[1].position_m, end_m);
    EXPECT_NEAR((end_m - 0.03) / path[1].time_s, rate_m_per_s, 1e-15) << name;
  }
}

TEST(SceneFile, ASidecarsChangesAreRead) {
  const std::string recording = R"(
[recording]
rows = 10
first_tick = 7
repeatable = false
not_repeatable_because = "the pointer led the hand"
[[recording.change]]
tick = 12
[recording.change.algorithm]
name = "none"
[[recording.change.wall]]
position_m = 0.04
stiffness_n_per_m = 100
)";
  const Result<LoadedScene> loaded = parse_scene(kWholeScene + recording, "x.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->first_recorded_tick, 7U);
  EXPECT_EQ(loaded->not_repeatable_because, "the pointer led the hand");
  ASSERT_EQ(loaded->changes.size(), 1U);
  EXPECT_EQ(loaded->changes[0].tick, 12U);
  EXPECT_EQ(loaded->changes[0].scene.algorithm.index, find_algorithm("none"));
  ASSERT_EQ(loaded->changes[0].scene.x().walls.size(), 1U);
  EXPECT_EQ(loaded->changes[0].scene.x().walls[0].position_m, 0.04);
  EXPECT_EQ(loaded->changes[0].scene.x().device.mass_kg, 0.05);
}

}  // namespace
}  // namespace hapticwall::file
