// `map` in a script: table, files, parts, an interruption, boundaries, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/summary.h"
#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

const std::vector<std::string> kSmall{"map",          "golden-soft",
                                      "--x",          "wall.stiffness_n_per_m=100:3000:6:log",
                                      "--y",          "device.damping_n_s_per_m=0.1:0.7:4",
                                      "--algorithms", "none,energy-bounding",
                                      "--duration",   "1.5"};

class MapCommand : public ProgramTest {
 protected:
  [[nodiscard]] Answer map(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = kSmall;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hapticwall(arguments);
  }
};

TEST_F(MapCommand, CountsTheVerdictsOfEveryAlgorithm) {
  const Answer answer = map({});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out,
              AllOf(StartsWith("golden-soft\nx: wall.stiffness_n_per_m from 100 to 3000 N/m in 6 "
                               "equal ratios\ny: device.damping_n_s_per_m from 0.1 to 0.7 N·s/m in "
                               "4 equal steps\n\nalgorithm "),
                    HasSubstr("\nnone "), HasSubstr("\nenergy-bounding ")));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(MapCommand, WritesRowsCountsAndAFigure) {
  const Answer answer = map({"--csv", "m.csv", "--json", "m.json", "--plot", "m.png", "--quiet"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("m.csv", "m.json", "m.png", "m.toml"));
  const std::string csv = content("m.csv");
  EXPECT_THAT(csv,
              StartsWith("algorithm,wall.stiffness_n_per_m,device.damping_n_s_per_m,verdict,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 49);
  EXPECT_THAT(content("m.png"), StartsWith("\x89PNG\r\n"));
  const auto json = nlohmann::json::parse(content("m.json"));
  EXPECT_EQ(json.at("cells"), 48);
  EXPECT_EQ(json.at("x").at("key"), "wall.stiffness_n_per_m");
  for (const auto& row : json.at("algorithms")) {
    int cells = 0;
    for (const std::string_view verdict : kVerdictNames) cells += row.at(verdict).get<int>();
    EXPECT_EQ(cells, 24);
  }
}

TEST_F(MapCommand, ACellIsWhatRunSaysOfIt) {
  ASSERT_EQ(map({"--csv", "m.csv", "--quiet"}).status, 0);
  const Answer one = hapticwall({"run", "golden-soft", "--algorithm", "energy-bounding",
                                 "--duration", "1.5", "--set", "wall.stiffness_n_per_m=3000",
                                 "--set", "device.damping_n_s_per_m=0.1", "--json", "-"});
  const auto json = nlohmann::json::parse(one.out);
  EXPECT_THAT(content("m.csv"),
              HasSubstr("\nenergy-bounding,3000,0.1," + json.at("verdict").get<std::string>() +
                        "," + json.at("tail_peak_to_peak_m").dump() + ","));
}

TEST_F(MapCommand, PartsPutTogetherAreTheWholeAndAreDrawn) {
  ASSERT_EQ(map({"--csv", "whole.csv", "--plot", "whole.png", "--quiet"}).status, 0);
  for (const char* part : {"1", "2", "3", "4", "5"}) {
    ASSERT_EQ(map({"--shard", std::string(part) + "/5", "--csv", "p" + std::string(part) + ".csv",
                   "--quiet"})
                  .status,
              0);
  }
  ASSERT_EQ(shell("cat p1.csv p2.csv p3.csv p4.csv p5.csv > all.csv").status, 0);
  EXPECT_EQ(content("all.csv"), content("whole.csv"));
  const Answer read = map({"--read", "all.csv", "--plot", "all.png"});
  ASSERT_EQ(read.status, 0) << read.err;
  EXPECT_EQ(content("all.png"), content("whole.png"));
  EXPECT_EQ(read.out, map({}).out);
  EXPECT_THAT(read.err, IsEmpty());
  // Only the sidecar identifies the scene of the cells.
  EXPECT_THAT(map({"--read", "whole.csv"}).err, IsEmpty());
  const Answer other = map({"--read", "whole.csv", "--set", "device.mass_kg=0.5"});
  EXPECT_EQ(other.status, 0);
  EXPECT_THAT(other.err, HasSubstr("note: whole.toml describes another scene or plan"));
}

TEST_F(MapCommand, AKilledRunIsGoneOnWith) {
  std::vector<std::string> arguments{program(), "map", "press", "--algorithms", "none"};
  arguments.insert(arguments.end(), {"--x", "wall.stiffness_n_per_m=1e3:1e5:50:log"});
  arguments.insert(arguments.end(), {"--y", "wall.damping_n_s_per_m=0:5:30"});
  arguments.insert(arguments.end(), {"--duration", "2", "--quiet", "--csv", "k.csv"});
  const pid_t child = start(arguments);
  wait_until_written(child, "k.csv.partial", 5000);  // rows to resume from
  const bool killed = kill(child, SIGKILL) == 0 && wait_for(child).status == 128 + SIGKILL;
  if (killed) {
    EXPECT_EQ(size("k.csv"), 0U);
    EXPECT_GT(size("k.csv.partial"), 0U);
  }
  const Answer second = wait_for(start(arguments));
  ASSERT_EQ(second.status, 0) << second.err;
  arguments.back() = "w.csv";
  ASSERT_EQ(wait_for(start(arguments)).status, 0);
  EXPECT_EQ(content("k.csv"), content("w.csv"));
  EXPECT_THAT(files(), ElementsAre("k.csv", "k.toml", "w.csv", "w.toml"));
}

TEST_F(MapCommand, CtrlCKeepsWhatIsThereAndSaysHowToGoOn) {
  const pid_t child =
      start({program(), "map", "press", "--x", "wall.stiffness_n_per_m=1e3:1e5:200:log", "--y",
             "wall.damping_n_s_per_m=0:5:200", "--algorithms", "none,half-sample", "--csv", "c.csv",
             "--quiet"});
  wait_until_written(child, "c.csv.partial", 2000);
  kill(child, SIGINT);
  const Answer answer = wait_for(child);
  EXPECT_EQ(answer.status, 130);
  EXPECT_THAT(answer.err, AllOf(StartsWith("ended early by Ctrl-C after "),
                                HasSubstr("of 80000 cells; c.csv.partial holds them")));
  EXPECT_THAT(files(), ElementsAre("c.csv.partial", "c.toml.partial"));
}

TEST_F(MapCommand, ABoundaryIsFoundAndWritten) {
  const Answer answer =
      hapticwall({"map", "golden-soft", "--boundary", "wall.stiffness_n_per_m=100:1e5:7:log", "--x",
                  "device.damping_n_s_per_m=0.5:1:2", "--algorithms", "none", "--duration", "20",
                  "--csv", "b.csv", "--json", "-"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const auto json = nlohmann::json::parse(answer.out);
  ASSERT_EQ(json.at("boundaries").size(), 2U);
  for (const auto& row : json.at("boundaries")) {
    const double settled = row.at("last_settled");
    const double failure = row.at("first_failure");
    EXPECT_LT(settled, failure);
    EXPECT_LE(failure - settled, 1e-3 * failure);
    const double limit = row.at("stable_below_n_per_m");
    EXPECT_NEAR(failure / limit, 1.0, 0.02);
  }
  EXPECT_LT(json.at("boundaries")[0].at("last_settled"),
            json.at("boundaries")[1].at("last_settled"));
  const std::string csv = content("b.csv");
  EXPECT_THAT(csv, StartsWith("algorithm,device.damping_n_s_per_m,first_settled,last_settled,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
}

TEST_F(MapCommand, ABoundaryHasNoLimitOfTheoryWhereTheLoopIsAnotherOne) {
  const auto limit_of = [&](const char* scene, const char* boundary, const char* algorithm) {
    const Answer answer = hapticwall({"map", scene, "--boundary", boundary, "--algorithms",
                                      algorithm, "--duration", "1", "--json", "-"});
    EXPECT_EQ(answer.status, 0) << answer.err;
    return nlohmann::json::parse(answer.out).at("boundaries").at(0).at("stable_below_n_per_m");
  };
  const char* stiffness = "wall.stiffness_n_per_m=100:1000:2";
  EXPECT_TRUE(limit_of("golden-soft", stiffness, "none").is_number());
  EXPECT_TRUE(limit_of("golden-soft", stiffness, "half-sample").is_null());
  EXPECT_TRUE(limit_of("golden-soft-fric", stiffness, "none").is_null());
  EXPECT_TRUE(limit_of("golden-soft", "device.mass_kg=0.1:0.2:2", "none").is_null());
}

}  // namespace
}  // namespace hapticwall::command::test
