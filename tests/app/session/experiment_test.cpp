// An experiment: the slots of a list as scenes, and what cannot be one.
#include "app/session/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/temporary_folder.h"

namespace hapticwall::session {
namespace {

using ::testing::HasSubstr;

Result<Scene> press_with(std::span<const std::string> overrides) {
  Result<file::LoadedScene> loaded = file::load_scene("press", overrides);
  if (!loaded) return loaded.error();
  return loaded->scene;
}

class ExperimentTest : public hapticwall::test::FolderTest {
 protected:
  Result<std::shared_ptr<Experiment>> open(const std::string& list, bool on_device = false) {
    put("list.csv", list);
    return open_experiment({path("list.csv"), participant, "1", path("out.csv"), on_device},
                           press_with);
  }
  std::string participant = "P1";
};

TEST_F(ExperimentTest, ASlotIsTheSceneWithItsKeys) {
  const auto experiment =
      open("a,b\nwall.stiffness_n_per_m=1000,wall.stiffness_n_per_m=1200; algorithm=half-sample\n");
  ASSERT_TRUE(experiment) << experiment.error().message;
  Scene expected = *press_with({});
  expected.x().walls.front().stiffness_n_per_m = 1000.0;
  EXPECT_EQ((*experiment)->scenes.front()[0], expected);
  expected.x().walls.front().stiffness_n_per_m = 1200.0;
  expected.algorithm.index = *find_algorithm("half-sample");
  EXPECT_EQ((*experiment)->scenes.front()[1], expected);
  EXPECT_EQ((*experiment)->name, "list");
}

// The values of an empty slot are those of assets/scenes/press.toml.
TEST_F(ExperimentTest, AColumnHasTheValueOfEachWall) {
  const auto experiment = open(
      "a,b,step\n,wall.stiffness_n_per_m=1200; algorithm=half-sample,1\n"
      "wall.stiffness_n_per_m=1e4,hand.path_file=none; hand.mass_kg=0.5,2\n");
  ASSERT_FALSE(experiment) << "hand.path_file cannot change";
  const auto right = open(
      "a,b,step\n,wall.stiffness_n_per_m=1200; algorithm=half-sample,1\n"
      "wall.stiffness_n_per_m=1e4,hand.mass_kg=0.5,2\n");
  ASSERT_TRUE(right) << right.error().message;
  const file::AnswerColumns& columns = *(*right)->answers.columns();
  EXPECT_THAT(columns.keys,
              ::testing::ElementsAre("wall.stiffness_n_per_m", "algorithm.name", "hand.mass_kg"));
  EXPECT_THAT(columns.extras, ::testing::ElementsAre("step"));
  EXPECT_THAT(values_at(**right, 0), ::testing::ElementsAre("35000", "1200", "energy-bounding",
                                                            "half-sample", "0.4", "0.4"));
  EXPECT_THAT(values_at(**right, 1), ::testing::ElementsAre("10000", "35000", "energy-bounding",
                                                            "energy-bounding", "0.4", "0.5"));
}

TEST_F(ExperimentTest, WhatCannotChangeInTheLoopIsRefusedWithItsLine) {
  for (const auto& [slot, why] :
       {std::pair("sampling.rate_hz=500", "sampling.rate_hz: cannot change"),
        {"device.start_m=0.02", "device.start_m: cannot change"},
        {"hand.path=[[0, 0.03]]", "hand.path: cannot change"},
        {"duration_s=2", "duration_s are those of the session"}}) {
    const auto experiment =
        open("a,b\n,wall.stiffness_n_per_m=1\n,\"" + std::string(slot) + "\"\n");
    ASSERT_FALSE(experiment) << slot;
    EXPECT_EQ(experiment.error().kind, ErrorKind::kUsage);
    EXPECT_THAT(experiment.error().message, HasSubstr("list.csv:3: b: " + std::string(slot)));
    EXPECT_THAT(experiment.error().message, HasSubstr(why));
    EXPECT_FALSE(std::filesystem::exists(path("out.csv")));
  }
}

TEST_F(ExperimentTest, WhatADeviceIgnoresIsRefusedOnADevice) {
  for (const char* slot : {"hand.mass_kg=0.5", "simulator.integrator=rk4"}) {
    const std::string list = "a,b\n," + std::string(slot) + "\n";
    EXPECT_TRUE(open(list)) << slot;
    std::filesystem::remove(path("out.csv"));
    EXPECT_THAT(open(list, true).error().message, HasSubstr("a device has no simulat")) << slot;
  }
}

TEST_F(ExperimentTest, AParticipantHasAnOrderOfTheirOwn) {
  const std::string list = "a,b\n,wall.stiffness_n_per_m=1\n";
  const std::uint64_t seed = (*open(list))->answers.identity().seed;
  EXPECT_EQ((*open(list))->answers.identity().seed, seed);
  participant = "P2";
  EXPECT_NE((*open(list))->answers.identity().seed, seed);
}

TEST_F(ExperimentTest, ASeedIsExactAsADouble) {
  constexpr int kParticipants = 50;  // with 64 random bits, 1 seed in 2048 would pass
  for (int i = 0; i < kParticipants; ++i) {
    participant = "P" + std::to_string(i);
    const std::uint64_t seed = (*open("a,b\n,algorithm=none\n"))->answers.identity().seed;
    EXPECT_EQ(static_cast<std::uint64_t>(static_cast<double>(seed)), seed);
    EXPECT_LE(seed, file::kMaxSeed);
    std::filesystem::remove(path("out.csv"));
  }
}

TEST_F(ExperimentTest, AnswersOfOtherTrialsAreRefused) {
  const std::string list = "trial,a,b\n5,,wall.stiffness_n_per_m=1\n6,,wall.stiffness_n_per_m=2\n";
  const auto store = [&](std::uint64_t trial) {
    auto experiment = open(list);
    ASSERT_TRUE(experiment) << experiment.error().message;
    file::Answer answer = (*experiment)->answers.identity();
    answer.trial = trial;
    ASSERT_FALSE((*experiment)->answers.append(answer));
  };
  store(5);
  EXPECT_EQ((*open(list))->answers.found().size(), 1U);
  store(7);
  EXPECT_THAT(open(list).error().message, HasSubstr("do not follow the trial list"));
}

}  // namespace
}  // namespace hapticwall::session
