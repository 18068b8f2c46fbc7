// `compare --hands` as a script sees it: table, JSON, CSV, and the same numbers as `run`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/file/scene/hand_description.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class HandsCommand : public ProgramTest {
 protected:
  [[nodiscard]] nlohmann::json json_of(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", "-"});
    const Answer answer = hapticwall(arguments);
    EXPECT_EQ(answer.status, 0) << answer.err;
    return nlohmann::json::parse(answer.out);
  }
};

TEST_F(HandsCommand, IsATableOfAllAlgorithms) {
  const Answer answer = hapticwall({"compare", "press", "--hands", "all", "--duration", "2.5"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.err, IsEmpty());
  EXPECT_THAT(answer.out,
              AllOf(StartsWith("press: 9 hands on the scene's path, friction 0.14 N, delay 0 "
                               "ticks, 2.5 s\nown hand: 0.4 kg, 250 N/m, 33 N s/m, grip 1000 N/m, "
                               "1 N s/m\n"),
                    HasSubstr("\nvan-beek-arm: 0.554 kg, 135 N/m, 6.45 N s/m, no grip\n"),
                    HasSubstr("\nkuchenbecker-joystick: no mass, 40 N/m, 23 N s/m, no grip\n")));
  for (const AlgorithmDescription& algorithm : algorithms())
    EXPECT_THAT(answer.out, HasSubstr("\n" + std::string(algorithm.name) + " "));
  EXPECT_THAT(files(), IsEmpty());
}

// The rows say what single runs say.
TEST_F(HandsCommand, EqualsRun) {
  const std::vector<std::string> names{"fu-cavusoglu-x", "fu-cavusoglu-z-low", "van-beek-arm"};
  const auto study =
      json_of({"compare", "tap", "--hands", names[0] + "," + names[1] + "," + names[2],
               "--algorithms", "energy-bounding", "--duration", "3"});
  EXPECT_EQ(study.at("hands").at("van-beek-arm").at("mass_kg"), 0.554);
  EXPECT_TRUE(study.at("hands").at("van-beek-arm").at("grip_stiffness_n_per_m").is_null());
  const auto& row = study.at("rows").at(0);
  EXPECT_EQ(row.at("hands"), 3);
  double max_given_j = 0.0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto run = json_of({"run", "tap", "--algorithm", "energy-bounding", "--duration", "3",
                              "--set", "hand=" + names[i]});
    const auto& of_study = row.at("runs").at(i);
    EXPECT_EQ(of_study.at("hand"), names[i]);
    for (const char* key : {"verdict", "chatter_n", "swing_m", "given_j", "tail_peak_to_peak_m",
                            "displayed_stiffness_n_per_m", "passivity_margin_j"})
      EXPECT_EQ(of_study.at(key), run.at(key)) << names[i] << " " << key;
    max_given_j = std::max(max_given_j, run.at("given_j").get<double>());
    if (row.at("worst_hand") == names[i]) EXPECT_EQ(row.at("worst_verdict"), run.at("verdict"));
  }
  EXPECT_EQ(row.at("max_given_j"), max_given_j);
  const auto own = json_of({"run", "tap", "--algorithm", "energy-bounding", "--duration", "3"});
  EXPECT_EQ(row.at("own_verdict"), own.at("verdict"));
}

TEST_F(HandsCommand, FilesAreWritten) {
  const Answer answer = hapticwall({"compare", "press", "--hands", "van-beek-arm", "--duration",
                                    "1", "--csv", "a.csv", "--json", "a.json", "--quiet"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("a.csv", "a.json"));
  EXPECT_THAT(content("a.csv"),
              StartsWith("scene,duration_s,rate_hz,friction_n,delay_ticks,algorithm,own_verdict,"));
  EXPECT_EQ(nlohmann::json::parse(content("a.json")).at("rows").size(), 10U);
}

// A recorded path stays, and the hand on it is another one.
TEST_F(HandsCommand, TakesARecording) {
  ASSERT_EQ(hapticwall({"run", "press", "--duration", "1.5", "--csv", "r.csv", "--quiet"}).status,
            0);
  const auto study =
      json_of({"compare", "r.csv", "--hands", "van-beek-arm", "--algorithms", "none", "--quiet"});
  EXPECT_EQ(study.at("rows").at(0).at("runs").size(), 1U);
}

}  // namespace
}  // namespace hapticwall::command::test
