// `accuracy` as a script sees it: table, JSON, CSV, picture, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class AccuracyCommand : public ProgramTest {};

TEST_F(AccuracyCommand, ShowsThatTheLimitCycleVanishes) {
  const Answer answer = hapticwall({"accuracy", "golden-hard", "--substeps", "1,10"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.err, IsEmpty());
  EXPECT_THAT(answer.out,
              AllOf(StartsWith("golden-hard under none, 5000 ticks\nreference: oscillating, 0.9903 "
                               "mm peak to peak"),
                    HasSubstr("\nexact "), HasSubstr("\nsemi-implicit-euler        10 "),
                    HasSubstr("  0.0000    -100.00  settled !\n"), HasSubstr("\nrk4 ")));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(AccuracyCommand, JsonOnStandardOutputIsAllThereIs) {
  const Answer answer =
      hapticwall({"accuracy", "golden-hard", "--substeps", "10,1,10", "--json", "-"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json.at("scene"), "golden-hard");
  EXPECT_EQ(json.at("reference_verdict"), "oscillating");
  std::vector<std::string> rows;
  for (const auto& row : json.at("rows")) {
    rows.push_back(row.at("integrator").get<std::string>() + " " + row.at("substeps").dump());
    EXPECT_GT(row.at("ns_per_tick").get<double>(), 0.0);
    EXPECT_GT(row.at("ratio_to_exact").get<double>(), 0.0);
    EXPECT_GE(row.at("set_up_ns").get<double>(), 0.0);
    EXPECT_TRUE(row.at("max_position_error_m").is_number());
  }
  // The rows are in ascending order, each count of substeps once.
  EXPECT_THAT(rows, ElementsAre("exact null", "semi-implicit-euler 1", "semi-implicit-euler 10",
                                "rk4 1", "rk4 10"));
  EXPECT_EQ(json.at("rows")[1].at("verdict"), "settled");
  EXPECT_EQ(json.at("rows")[1].at("verdict_agrees"), false);
  EXPECT_LE(json.at("rows")[0].at("max_position_error_m").get<double>(), 1e-14);
}

// Without times, so that two calls agree byte for byte.
TEST_F(AccuracyCommand, CountsTheRightHands) {
  const std::vector<std::string> arguments{"accuracy",   "golden-hard", "--hands",    "5",
                                           "--substeps", "1,100",       "--duration", "2"};
  const Answer answer = hapticwall(arguments);
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_EQ(hapticwall(arguments).out, answer.out);
  EXPECT_THAT(answer.out,
              AllOf(StartsWith("golden-hard under none: 5 hands of 285 to 315 N/m in equal steps, "
                               "each against exact\nexact: 5 of them oscillate, "),
                    ::testing::ContainsRegex("\nsemi-implicit-euler +1 +0 of 5 +100\\.00 +0\n"),
                    ::testing::ContainsRegex("\nrk4 +100 +5 of 5 +0\\.00 +5\n")));
}

TEST_F(AccuracyCommand, TheHandsAreWritten) {
  const Answer answer =
      hapticwall({"accuracy", "golden-hard", "--hands", "3", "--substeps", "10", "--duration", "2",
                  "--csv", "a.csv", "--json", "a.json", "--plot", "a.png", "--quiet"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(files(), ElementsAre("a.csv", "a.json", "a.png"));
  const auto json = nlohmann::json::parse(content("a.json"));
  EXPECT_EQ(json.at("hands"), 3);
  EXPECT_EQ(json.at("hand_stiffness_from_n_per_m"), 285.0);
  EXPECT_EQ(json.at("oscillating_hands"), 3);
  ASSERT_EQ(json.at("rows").size(), 2U);
  EXPECT_EQ(json.at("rows")[1].at("hands_within_one_percent"), 3);
  EXPECT_THAT(content("a.csv"), StartsWith("scene,algorithm,duration_s,hands,"));
}

TEST_F(AccuracyCommand, FilesAreWritten) {
  const Answer answer = hapticwall({"accuracy", "golden-hard", "--substeps", "1,2", "--csv",
                                    "a.csv", "--json", "a.json", "--plot", "a.png", "--quiet"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, IsEmpty());
  EXPECT_THAT(answer.err, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("a.csv", "a.json", "a.png"));
  EXPECT_EQ(nlohmann::json::parse(content("a.json")).at("rows").size(), 5U);
  EXPECT_THAT(content("a.csv"), StartsWith("scene,algorithm,"));
  EXPECT_THAT(content("a.png"), StartsWith("\x89PNG\r\n"));
}

TEST_F(AccuracyCommand, SettingsReachTheStudyAndTheScenesIntegratorDoesNotMatter) {
  const auto study = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{
        "accuracy", "press",      "--substeps", "1",     "--json",
        "-",        "--duration", "2",          "--set", "wall.position_m=0.04"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return nlohmann::json::parse(hapticwall(arguments).out);
  };
  const auto json = study({"--algorithm", "none"});
  EXPECT_EQ(json.at("algorithm"), "none");
  EXPECT_EQ(json.at("ticks"), 2000);
  const auto other =
      study({"--algorithm", "none", "--set", "simulator.integrator=semi-implicit-euler", "--set",
             "simulator.substeps=3"});
  for (std::size_t i = 0; i < json.at("rows").size(); ++i) {
    EXPECT_EQ(json.at("rows")[i].at("tail_peak_to_peak_m"),
              other.at("rows")[i].at("tail_peak_to_peak_m"));
  }
}

TEST_F(AccuracyCommand, ADivergedRunIsARowLikeAnother) {
  const Answer answer = hapticwall({"accuracy", "press", "--substeps", "1", "--duration", "2",
                                    "--set", "hand.grip_stiffness_n_per_m=1e7", "--json", "-"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const auto rows = nlohmann::json::parse(answer.out).at("rows");
  EXPECT_NE(rows[0].at("verdict"), "diverged");
  EXPECT_EQ(rows[1].at("verdict"), "diverged");
  EXPECT_TRUE(rows[1].at("diverged_at_tick").is_number());
  EXPECT_TRUE(rows[1].at("max_position_error_m").is_null());
}

TEST_F(AccuracyCommand, Help) {
  const Answer answer = hapticwall({"accuracy", "--help"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.out, AllOf(HasSubstr("hapticwall accuracy [OPTIONS] SCENE"),
                                HasSubstr("--substeps N,N,..."), HasSubstr("--plot FILE"),
                                HasSubstr("--algorithm")));
  EXPECT_THAT(hapticwall({"--help"}).out, HasSubstr("accuracy"));
}

}  // namespace
}  // namespace hapticwall::command::test
