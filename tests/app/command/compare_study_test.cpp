// `compare --study` as a script sees it: table, JSON, CSV, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class StudyCommand : public ProgramTest {};

TEST_F(StudyCommand, IsATableOfAllAlgorithms) {
  const Answer answer = hapticwall({"compare", "tap", "--study"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.err, IsEmpty());
  EXPECT_THAT(
      answer.out,
      AllOf(StartsWith("tap: wall of 35.00 kN/m, met at 0.253 m/s, 6 s\nlimits: 926 stiffnesses "
                       "of the wall from 100 to 1e+06 N/m in steps of 1 %, refined to "
                       "0.001\n"),
            HasSubstr("rate-hardness"), ::testing::ContainsRegex("\nvirtual-coupling +2\\.00")));
  for (const AlgorithmDescription& algorithm : algorithms()) {
    EXPECT_THAT(answer.out, HasSubstr("\n" + std::string(algorithm.name) + " "));
  }
  EXPECT_THAT(answer.out, AllOf(HasSubstr("\npassivity-control (held-force) "),
                                HasSubstr("\npassivity-control (one-step) ")));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(StudyCommand, JsonOnStandardOutputIsAllThereIs) {
  const Answer answer = hapticwall({"compare", "tap", "--study", "--algorithms",
                                    "energy-bounding,virtual-coupling", "--json", "-"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json.at("scene"), "tap");
  EXPECT_EQ(json.at("wall_stiffness_n_per_m"), 35000.0);
  EXPECT_EQ(json.at("scan_count"), 926);
  ASSERT_EQ(json.at("rows").size(), 2U);
  const auto& bounding = json.at("rows")[0];
  EXPECT_EQ(bounding.at("algorithm"), "energy-bounding");
  EXPECT_NEAR(bounding.at("energy_to_hand_j").get<double>(), 2.88, 0.005);
  EXPECT_EQ(bounding.at("verdict"), "oscillating");
  EXPECT_TRUE(bounding.at("rise_time_s").is_null());
  EXPECT_LT(bounding.at("first_failure"), 3000.0);
  const auto& coupling = json.at("rows")[1];
  EXPECT_EQ(coupling.at("energy_to_hand_j"), 0.0);
  EXPECT_TRUE(coupling.at("first_failure").is_null());
  EXPECT_EQ(coupling.at("last_settled"), 1e6);
  const double displayed = 1e6 * 2000.0 / (1e6 + 2000.0);
  EXPECT_NEAR(coupling.at("stiffest_n_per_m").get<double>(), displayed, 1e-3);
  EXPECT_TRUE(coupling.at("rise_time_s").is_number());
  EXPECT_TRUE(coupling.at("rate_hardness_n_per_m").is_number());
}

TEST_F(StudyCommand, TellsTheLimitOfTheoryOfTheBareLinearLoop) {
  const Answer answer = hapticwall({"compare", "golden-soft", "--study", "--algorithms",
                                    "none,energy-bounding", "--duration", "1", "--json", "-"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const auto rows = nlohmann::json::parse(answer.out).at("rows");
  // The limit is that of tests/golden/loop_eigenvalues.h.
  EXPECT_NEAR(rows.at(0).at("stable_below_n_per_m").get<double>(), 12061.811, 1e-3);
  EXPECT_TRUE(rows.at(1).at("stable_below_n_per_m").is_null());
}

TEST_F(StudyCommand, FilesAreWritten) {
  const Answer answer = hapticwall({"compare", "light", "--study", "--csv", "a.csv", "--json",
                                    "a.json", "--quiet", "--duration", "2"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("a.csv", "a.json"));
  const auto json = nlohmann::json::parse(content("a.json"));
  EXPECT_EQ(json.at("duration_s"), 2.0);
  const std::string csv = content("a.csv");
  const auto lines = std::count(csv.begin(), csv.end(), '\n');
  EXPECT_EQ(lines, 1 + std::ssize(algorithms()) + 2);  // three forms of passivity-control
  // The CSV has the same keys as the JSON, and the same number of fields in every line.
  const std::string header = csv.substr(0, csv.find('\n'));
  EXPECT_THAT(header, StartsWith("scene,duration_s,rate_hz,"));
  for (const auto& [key, value] : json.at("rows")[0].items()) EXPECT_THAT(header, HasSubstr(key));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','),
            lines * std::count(header.begin(), header.end(), ','));
  EXPECT_THAT(csv, HasSubstr("\nlight,2,1000,35000,100,1e+06,926,0.001,none,"));
}

TEST_F(StudyCommand, IsTheSameEveryTime) {
  const auto run = [&] {
    return hapticwall({"compare", "press", "--study", "--json", "-", "--duration", "3",
                       "--algorithms", "none,half-sample,energy-bounding"})
        .out;
  };
  const std::string first = run();
  EXPECT_THAT(first, HasSubstr("half-sample"));
  EXPECT_EQ(first, run());
}

TEST_F(StudyCommand, AStudyOfACornerIsOfAxisX) {
  const Answer answer = hapticwall(
      {"compare", "corner", "--study", "--algorithms", "force-bounding", "--duration", "2"});
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, StartsWith("corner, axis x: wall of "));
}

TEST_F(StudyCommand, IsInTheHelp) {
  EXPECT_THAT(hapticwall({"compare", "--help"}).out, HasSubstr("--study"));
}

TEST_F(StudyCommand, AddsASearchForAHandOnDemand) {
  const Answer answer =
      hapticwall({"compare", "tap", "--duration", "1", "--study", "--algorithms",
                  "force-bounding,none", "--worst-hand", "60", "--json", "a.json"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, AllOf(HasSubstr("  60 hands\n"), HasSubstr("  J typical\n"),
                                HasSubstr("\n60 hands: median energy")));
  const auto rows = nlohmann::json::parse(content("a.json")).at("rows");
  EXPECT_TRUE(rows[0].at("typical_taken_j").is_null());
  const Answer found = hapticwall({"worst-hand", "tap", "--duration", "1", "--algorithm", "none",
                                   "--hands", "60", "--json", "-"});
  const auto none = nlohmann::json::parse(found.out).at("rows")[0];
  EXPECT_EQ(rows[1].at("typical_taken_j"), none.at("typical_j"));
  EXPECT_EQ(rows[1].at("most_taken_j"), none.at("most_j"));
}

}  // namespace
}  // namespace hapticwall::command::test
