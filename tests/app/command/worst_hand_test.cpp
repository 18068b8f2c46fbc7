// `worst-hand` as a script sees it: its files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class WorstHandCommand : public ProgramTest {};

TEST_F(WorstHandCommand, TheSceneFileRepeatsTheEnergy) {
  const Answer answer =
      hapticwall({"worst-hand", "tap", "--hands", "20", "--duration", "1.5", "--csv", "a.csv",
                  "--json", "a.json", "--plot", "a.png", "--scene-file", "found.toml", "--quiet"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("a.csv", "a.json", "a.png", "found.toml"));
  const auto row = nlohmann::json::parse(content("a.json")).at("rows")[0];
  const Answer run = hapticwall({"run", "found.toml", "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out).at("passivity_margin_j").get<double>(),
            -row.at("taken_j").get<double>());
}

TEST_F(WorstHandCommand, ASearchThatFindsNoHandWritesNoScene) {
  const Answer answer = hapticwall({"worst-hand", "tap", "--hands", "5", "--duration", "0.2",
                                    "--algorithm", "force-bounding", "--scene-file", "none.toml"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("-: no hand took 1e-9 J; that proves nothing"));
  EXPECT_THAT(files(), IsEmpty());
}

}  // namespace
}  // namespace hapticwall::command::test
