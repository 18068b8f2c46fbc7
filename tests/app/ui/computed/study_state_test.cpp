#include "app/ui/computed/study_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
#include "core/study/accuracy.h"
#include "tests/app/command/binary.h"
#include "tests/app/session/support.h"

namespace hapticwall::test {
namespace {

using study::Outcome;
using ::testing::HasSubstr;
using ui::SceneStudy;

Scene brief(const std::string& name, double duration_s) {
  Scene scene = file::load_scene(name)->scene;
  scene.duration_s = duration_s;
  return scene;
}

Scene endless_scene() { return brief("press", 1e4); }

class SceneStudyTest : public command::test::ProgramTest {
 protected:
  static void wait_for_result(SceneStudy& study, const Scene& scene) {
    EXPECT_TRUE(session::test::eventually([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));  // it has the lowest priority
      study.take(scene, 0.0);
      return !study.running();
    }));
  }
  static const Outcome& computed(SceneStudy& study, const Scene& scene) {
    study.start(scene, 0.0);
    wait_for_result(study, scene);
    EXPECT_TRUE(study.complete());
    EXPECT_TRUE(study.up_to_date());
    EXPECT_EQ(study.problem(), "");
    return *study.result();
  }
};

TEST_F(SceneStudyTest, TheRankingIsWhatTheCommandPrintsToTheLastByte) {
  for (const char* name : {"press", "tap"}) {
    SceneStudy study(hapticwall::study::ranking_study());
    const Outcome& result = computed(study, brief(name, 2.0));
    const command::test::Answer printed =
        hapticwall({"compare", name, "--study", "--duration", "2", "--csv", "a.csv"});
    ASSERT_EQ(printed.status, 0) << printed.err;
    EXPECT_EQ(table::sheet_text(result.sheet), printed.out);
    EXPECT_EQ(result.csv, content("a.csv"));
    EXPECT_FALSE(result.figure);
    remove_files();
  }
}

// The fields of a CSV without times, which differ from run to run.
std::vector<std::string> lasting_fields(const std::string& csv) {
  std::vector<std::string> kept;
  std::vector<std::string_view> header;
  for (const std::string_view line : file::split(csv, '\n')) {
    const std::vector<std::string_view> fields = file::split(line, ',');
    if (header.empty()) header = fields;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::string_view key = header[i];
      if (key != "ns_per_tick" && key != "ratio_to_exact" && key != "set_up_ns") {
        kept.emplace_back(fields[i]);
      }
    }
  }
  return kept;
}

TEST_F(SceneStudyTest, TheAccuracyIsThatOfTheCommand) {
  for (const char* name : {"golden-hard", "tap"}) {
    SceneStudy study(hapticwall::study::accuracy_study());
    const Outcome& result = computed(study, brief(name, 0.1));
    const command::test::Answer printed =
        hapticwall({"accuracy", name, "--duration", "0.1", "--csv", "a.csv", "--quiet"});
    ASSERT_EQ(printed.status, 0) << printed.err;
    EXPECT_EQ(lasting_fields(result.csv), lasting_fields(content("a.csv")));
    EXPECT_EQ(result.sheet.rows.size(), 1 + 2 * kUsualSubsteps.size());
    EXPECT_TRUE(result.figure);
    const auto rows = nlohmann::json::parse(result.json).at("rows");
    EXPECT_EQ(rows.size(), result.sheet.rows.size());
    for (const auto& row : rows) EXPECT_GT(row.at("ns_per_tick").get<double>(), 0.0);
    remove_files();
  }
}

TEST_F(SceneStudyTest, TheAccuracyIsCoarseFirst) {
  SceneStudy study(hapticwall::study::accuracy_study());
  const Scene scene = brief("press", 0.5);
  study.start(scene, 10.0);
  EXPECT_TRUE(study.coarse());
  EXPECT_TRUE(session::test::eventually([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    study.take(scene, 12.5);
    return study.result() != nullptr;
  }));
  EXPECT_LT(study.result()->sheet.rows.size(), 1 + 2 * kUsualSubsteps.size());
  EXPECT_EQ(study.spent_s(), 2.5);
  EXPECT_TRUE(study.running());
  EXPECT_FALSE(study.coarse());
  EXPECT_FALSE(study.complete());
  EXPECT_EQ(study.elapsed_s(13.0), 0.5);
  study.stop();
  EXPECT_FALSE(study.running());
  EXPECT_NE(study.result(), nullptr);
  EXPECT_FALSE(study.complete());
}

TEST_F(SceneStudyTest, StopEndsItWithoutAResult) {
  for (const study::Study* kind : hapticwall::study::studies()) {
    SceneStudy study(*kind);
    study.start(endless_scene(), 0.0);
    EXPECT_TRUE(study.running());
    study.stop();
    EXPECT_FALSE(study.running());
    study.take(endless_scene(), 1.0);
    EXPECT_EQ(study.result(), nullptr);
  }
}

TEST_F(SceneStudyTest, AChangeOfTheSceneEndsItAndTheResultIsOfTheSceneBefore) {
  for (const study::Study* kind : hapticwall::study::studies()) {
    SceneStudy study(*kind);
    const Scene first = brief("press", 0.2);
    const std::string before = computed(study, first).csv;
    study.start(endless_scene(), 0.0);
    study.take(endless_scene(), 0.0);
    EXPECT_TRUE(study.running());
    EXPECT_FALSE(study.up_to_date());
    Scene other = endless_scene();
    other.x().device.mass_kg *= 2.0;
    study.take(other, 0.0);
    EXPECT_FALSE(study.running());
    EXPECT_FALSE(study.up_to_date());
    EXPECT_EQ(study.result()->csv, before);
    study.take(first, 0.0);
    EXPECT_TRUE(study.up_to_date()) << "back to its scene";
    EXPECT_TRUE(study.complete());
  }
}

TEST_F(SceneStudyTest, TheAlgorithmInForceMattersForTheAccuracyAlone) {
  const Scene scene = brief("press", 0.2);
  Scene under_another = scene;
  under_another.algorithm.index = (scene.algorithm.index + 1) % algorithms().size();
  SceneStudy ranking(study::ranking_study());
  SceneStudy accuracy(study::accuracy_study());
  computed(ranking, scene);
  computed(accuracy, scene);
  ranking.take(under_another, 0.0);
  accuracy.take(under_another, 0.0);
  EXPECT_TRUE(ranking.up_to_date());
  EXPECT_FALSE(accuracy.up_to_date());
}

TEST_F(SceneStudyTest, ASceneWithoutSuchAStudySaysWhyUntilItChanges) {
  Scene bare = brief("press", 1.0);
  bare.x().walls.clear();
  SceneStudy ranking(study::ranking_study());
  ranking.start(bare, 0.0);
  wait_for_result(ranking, bare);
  EXPECT_THAT(ranking.problem(), HasSubstr("wall"));
  EXPECT_EQ(ranking.result(), nullptr);
  ranking.take(endless_scene(), 0.0);
  EXPECT_EQ(ranking.problem(), "");
  const Scene long_one = brief("press", 1e5);
  SceneStudy accuracy(study::accuracy_study());
  accuracy.start(long_one, 0.0);
  wait_for_result(accuracy, long_one);
  EXPECT_THAT(accuracy.problem(), HasSubstr("at most 10000000 ticks"));
}

}  // namespace
}  // namespace hapticwall::test
