// Changes during a session: in the sidecar, and read back.
#include "app/file/recording/sidecar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "app/file/recording/recording_writer.h"
#include "app/file/scene/scene_file.h"

namespace hapticwall::file {
namespace {

using ::testing::HasSubstr;

Scene scene_with_everything() {
  Scene scene;
  scene.name = "everything";
  scene.x().device.friction_n = 0.14;
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().device.delay_ticks = 2;
  HandSettings hand;
  hand.mass_kg = 0.4;
  hand.stiffness_n_per_m = 250.0;
  hand.grip_stiffness_n_per_m = 1000.0;
  hand.path = {{0.0, 0.03}, {0.5, 0.06}};
  scene.x().hand = hand;
  return scene;
}

// `changes` as they read back from a sidecar.
std::vector<ScheduledChange> through_a_sidecar(const Scene& start,
                                               const std::vector<ScheduledChange>& changes) {
  RecordingMetadata metadata;
  metadata.changes = changes;
  const Result<LoadedScene> loaded =
      parse_scene(sidecar_toml(start, metadata, {8, 0, 8, "0"}), "a.toml");
  EXPECT_TRUE(loaded) << loaded.error().message;
  return loaded ? loaded->changes : std::vector<ScheduledChange>();
}

TEST(Sidecar, AnyEditIsSeenAndAnOlderOneWithoutASealIsRead) {
  const std::string text = sidecar_toml(scene_with_everything(), {}, {8, 0, 8, "0"});
  const auto edited = [](const std::string& toml) {
    const Result<LoadedScene> loaded = parse_scene(toml, "a.toml");
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded && loaded->edited;
  };
  EXPECT_FALSE(edited(text));
  for (const auto& [before, after] : {std::pair{"mass_kg = 0.4", "mass_kg = 0.5"},
                                      {"rows = 8", "rows = 9"},
                                      {"[recording]", "# a note\n[recording]"},
                                      {"sidecar_sha256 = \"", "sidecar_sha256 = \"0"}}) {
    std::string other = text;
    EXPECT_TRUE(edited(other.replace(other.find(before), std::string(before).size(), after)));
  }
  EXPECT_TRUE(edited(text + "\n"));
  const std::size_t begin = text.find("sidecar_sha256");
  std::string older = text;
  EXPECT_FALSE(edited(older.erase(begin, text.find('\n', begin) + 1 - begin)));
}

// Headers with spaces, with quotes, or inline: no excess change reaches the memory of a parser.
TEST(Sidecar, MoreChangesThanAreWrittenAreRefused) {
  const std::string scene = "[device]\nmass_kg = 1\ndamping_n_s_per_m = 1\n";
  for (const std::string header : {"[[recording.change]]", " [[ recording . 'change' ]]",
                                   "[[\"recording\".\"\\u0063hange\"]]"}) {
    std::string text = scene + "[recording]\n";
    for (std::size_t i = 0; i < kMaxChanges; ++i) text += header + "\ntick = 1\n";
    EXPECT_TRUE(parse_scene(text, "a.toml").ok());
    const auto refused = parse_scene(text + header + "\ntick = 1\n", "a.toml");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("more than 10000 changes of parameters"));
  }
  std::string text = scene + "[recording]\nchange = [";
  for (std::size_t i = 0; i <= kMaxChanges; ++i) text += "{tick=1},";
  EXPECT_THAT(parse_scene(text + "]", "a.toml").error().message,
              HasSubstr("a.toml: not a scene: more than 10000 changes of parameters"));
}

TEST(Sidecar, ChangesOfThePlantReadBackTheSame) {
  Scene start = scene_with_everything();
  start.sampling.jitter = 0.25;
  start.sampling.lost_ticks = 0.1;
  Scene device = start;
  device.sampling.lost_ticks.reset();
  device.sampling.render_every = 3;
  device.x().device.mass_kg = 0.1 + 0.2;
  device.x().device.friction_n.reset();
  device.x().device.delay_ticks = 7;
  device.x().device.amplifier_time_constant_s = 1e-3;
  Scene hand = device;
  hand.x().hand->grip_stiffness_n_per_m.reset();
  hand.x().hand->damping_n_s_per_m = 12.5;
  Scene simulator = hand;
  simulator.simulator = {Integrator::kRungeKutta4, 17};
  simulator.algorithm.index = 0;
  const std::vector<ScheduledChange> changes{{2, device}, {3, hand}, {4, simulator}, {5, start}};
  const std::vector<ScheduledChange> read = through_a_sidecar(start, changes);
  ASSERT_EQ(read.size(), changes.size());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    EXPECT_EQ(read[i].tick, changes[i].tick);
    EXPECT_EQ(read[i].scene.x().device, changes[i].scene.x().device) << i;
    EXPECT_EQ(read[i].scene.x().hand, changes[i].scene.x().hand) << i;
    EXPECT_EQ(read[i].scene.sampling, changes[i].scene.sampling) << i;
    EXPECT_EQ(read[i].scene.simulator, changes[i].scene.simulator) << i;
    EXPECT_EQ(read[i].scene.algorithm, changes[i].scene.algorithm) << i;
  }
}

TEST(Sidecar, AChangeSaysOfThePlantOnlyWhatDiffersFromTheStart) {
  const Scene start = scene_with_everything();
  Scene wall = start;
  wall.x().walls = {{0.05, 1000.0, 0.0}};
  Scene grip = start;
  grip.x().hand->grip_stiffness_n_per_m = 500.0;
  RecordingMetadata metadata;
  metadata.changes = {{2, wall}, {3, grip}};
  const std::string text = sidecar_toml(start, metadata, {8, 0, 8, "0"});
  EXPECT_THAT(text, ::testing::Not(HasSubstr("[recording.change.device]")));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("[recording.change.simulator]")));
  const std::size_t hand = text.find("[recording.change.hand]");
  ASSERT_NE(hand, std::string::npos);
  EXPECT_EQ(text.find("[recording.change.hand]", hand + 1), std::string::npos);
  EXPECT_GT(hand, text.find("tick = 3"));
  EXPECT_EQ(text.find("path", hand), std::string::npos);
}

// A file of an older version.
TEST(Sidecar, AChangeWithoutAPlantKeepsThatOfTheStart) {
  const std::string start = scene_to_toml(scene_with_everything());
  const auto read = [&](const std::string& table) {
    return parse_scene(start + "\n[recording]\n[[recording.change]]\ntick = 3\n" + table, "a.toml");
  };
  const Result<LoadedScene> old = read("[recording.change.algorithm]\nname = \"none\"\n");
  ASSERT_TRUE(old) << old.error().message;
  EXPECT_EQ(old->changes.at(0).scene.x().device, scene_with_everything().x().device);
  EXPECT_EQ(old->changes.at(0).scene.x().hand, scene_with_everything().x().hand);
}

}  // namespace
}  // namespace hapticwall::file
