// The keys of [algorithm] in files and on the command line: names and parameters.
#include "core/algorithm/algorithm.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/run/simulate.h"

namespace hapticwall::file {
namespace {

std::string scene_text(const std::string& algorithm) {
  return "[device]\nmass_kg = 0.05\ndamping_n_s_per_m = 1\n[[wall]]\nposition_m = 0.05\n"
         "stiffness_n_per_m = 1000\n[algorithm]\n" +
         algorithm;
}

TEST(AlgorithmFile, TakesEveryNameAndWritesItAgain) {
  for (const AlgorithmDescription& algorithm : algorithms()) {
    const auto loaded =
        parse_scene(scene_text("name = \"" + std::string(algorithm.name) + "\""), "x.toml");
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    EXPECT_EQ(loaded->scene.algorithm.index, find_algorithm(algorithm.name));
    EXPECT_FALSE(has_follower(loaded->scene.algorithm));
    EXPECT_NE(scene_to_toml(loaded->scene).find("name = \"" + std::string(algorithm.name) + "\""),
              std::string::npos);
  }
}

TEST(AlgorithmFile, TakesAnOldNameAndWritesThePresentOne) {
  const auto loaded = parse_scene(scene_text("name = \"energy-bookkeeping\""), "x.toml");
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(algorithm_label(loaded->scene.algorithm), "energy-limited-spring");
  const std::string text = scene_to_toml(loaded->scene);
  EXPECT_NE(text.find("name = \"energy-limited-spring\""), std::string::npos);
  EXPECT_EQ(text.find("bookkeeping"), std::string::npos);
}

TEST(AlgorithmFile, TakesWhatFollowsAndWritesItAgain) {
  const auto loaded =
      parse_scene(scene_text("name = \"force-bounding\"\nthen = \"passivity-control\""), "x.toml");
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_TRUE(has_follower(loaded->scene.algorithm));
  const std::string text = scene_to_toml(loaded->scene);
  EXPECT_NE(text.find("then = \"passivity-control\""), std::string::npos);
  const auto again = parse_scene(text, "x.toml");
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->scene.algorithm, loaded->scene.algorithm);
}

TEST(AlgorithmFile, IsSetFromTheCommandLine) {
  const std::vector<std::string> overrides{"algorithm.then=passivity-control",
                                           "algorithm.max_damping_n_s_per_m=5"};
  const auto loaded = load_scene("tap", overrides);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(algorithm_label(loaded->scene.algorithm), "energy-bounding then passivity-control");
  EXPECT_EQ(simulate(loaded->scene).summary.algorithm, "energy-bounding then passivity-control");
}

}  // namespace
}  // namespace hapticwall::file
