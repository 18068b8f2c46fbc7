// `replay` in a script: the recording, its hand under another algorithm, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class ReplayCommand : public ProgramTest {
 protected:
  void record(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"run", "press", "--csv", "a.csv", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(hapticwall(arguments).status, 0);
  }
  // a.csv with a hand that was led: its recorded path in place of the sidecar's script.
  void record_led() const {
    record();
    const std::string sidecar = content("a.toml");
    const std::size_t path = sidecar.find("path = ");
    replace_in("a.toml", sidecar.substr(path, sidecar.find('\n', path) - path), "path = \"mouse\"");
    replace_in("a.toml", "repeatable = true",
               "repeatable = false\nnot_repeatable_because = \"the pointer led the hand\"");
  }
};

TEST_F(ReplayCommand, SummarisesARecordingAsItIs) {
  record({"--json", "run.json"});
  const Answer answer = hapticwall({"replay", "a.csv", "--json", "-"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.err, IsEmpty());
  const auto run = nlohmann::json::parse(content("run.json"));
  const auto replay = nlohmann::json::parse(answer.out);
  for (const char* key : {"scene", "algorithm", "verdict", "ticks", "tail_peak_to_peak_m",
                          "tail_force_mean_n", "displayed_stiffness_n_per_m", "contacts",
                          "max_penetration_m", "peak_force_n", "energy_scv_j", "energy_budget_j"}) {
    EXPECT_EQ(replay[key], run[key]) << key;
  }
  EXPECT_TRUE(replay["ns_per_tick"].is_null());
  EXPECT_EQ(hapticwall({"replay", "a.csv", "--expect", "verdict=settled", "--quiet"}).status, 0);
  EXPECT_EQ(hapticwall({"replay", "a.csv", "--expect", "verdict=diverged"}).status, 1);
}

// Rows or sidecar that were changed since: a line each, and the work goes on.
TEST_F(ReplayCommand, EditsAreToldInALine) {
  record();
  EXPECT_THAT(hapticwall({"run", "a.toml", "--json", "-"}).err, IsEmpty());
  replace_in("a.csv", ",0.03,", ",0.04,");
  Answer answer = hapticwall({"run", "a.toml", "--json", "-"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.err,
            "note: a.csv has other rows than a.toml was written for: the run repeats the session, "
            "not these rows\n");
  replace_in("a.csv", ",0.04,", ",0.03,");
  replace_in("a.toml", "stiffness_n_per_m = 35000", "stiffness_n_per_m = 34000");
  answer = hapticwall({"run", "a.toml", "--json", "-"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.err,
            "note: a.toml was changed since it was written: the run will differ from the recorded "
            "session\n");
  answer = hapticwall({"replay", "a.csv", "--json", "-"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.err, "note: a.csv: its sidecar was changed since it was written\n");
}

TEST_F(ReplayCommand, ARunThatDivergedReplaysAsOne) {
  record({"--set", "wall.damping_n_s_per_m=1e4", "--set", "device.encoder_m=0", "--set",
          "device.force_limit_n=1e6", "--algorithm", "none", "--json", "run.json"});
  const auto run = nlohmann::json::parse(content("run.json"));
  ASSERT_EQ(run["verdict"], "diverged");
  const auto replay = nlohmann::json::parse(hapticwall({"replay", "a.csv", "--json", "-"}).out);
  for (const char* key : {"verdict", "diverged_at_tick", "ticks", "tail_peak_to_peak_m", "contacts",
                          "max_penetration_m", "verdict_note"}) {
    EXPECT_EQ(replay[key], run[key]) << key;
  }
  ASSERT_EQ(hapticwall({"replay", "a.csv", "--algorithm", "none", "--csv", "b.csv"}).status, 0);
  const auto rerun = nlohmann::json::parse(hapticwall({"replay", "b.csv", "--json", "-"}).out);
  for (const char* key : {"verdict", "diverged_at_tick"}) EXPECT_EQ(rerun[key], run[key]) << key;
}

TEST_F(ReplayCommand, ALinkIsFollowedToTheRecordingAndItsSidecar) {
  std::filesystem::create_directory(path("sub"));
  std::filesystem::create_symlink("sub/b.csv", path("a.csv"));
  record();
  EXPECT_TRUE(std::filesystem::is_symlink(path("a.csv")));
  EXPECT_THAT(files(), ElementsAre("a.csv", "sub"));
  EXPECT_THAT(hapticwall({"replay", "a.csv", "--json", "-"}).err, IsEmpty());
  EXPECT_EQ(hapticwall({"replay", "a.csv", "--set", "wall.damping_n_s_per_m=1", "--quiet"}).status,
            0);
  std::filesystem::rename(path("sub/b.csv"), path("sub/b.csv.partial"));
  EXPECT_EQ(hapticwall({"recover", "a.csv"}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(path("sub/b.csv")));
}

TEST_F(ReplayCommand, UnderItsOwnAlgorithmTheBytesComeOutAgain) {
  record();
  const Answer answer =
      hapticwall({"replay", "a.csv", "--algorithm", "energy-bounding", "--csv", "b.csv"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out,
              AllOf(StartsWith("press under energy-bounding: settled"),
                    HasSubstr("re-run                equal to the recording, bit for bit")));
  EXPECT_TRUE(content("a.csv") == content("b.csv"));
}

// A recording of a version that called its algorithm otherwise.
TEST_F(ReplayCommand, AnOldNameOfAnAlgorithmIsReadAndThePresentOneWritten) {
  record({"--algorithm", "energy-bookkeeping"});
  replace_in("a.toml", "name = \"energy-limited-spring\"", "name = \"energy-bookkeeping\"");
  const Answer shown = hapticwall({"replay", "a.csv", "--json", "-"});
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_EQ(nlohmann::json::parse(shown.out)["algorithm"], "energy-limited-spring");
  const Answer again =
      hapticwall({"replay", "a.csv", "--algorithm", "energy-bookkeeping", "--csv", "b.csv"});
  EXPECT_THAT(again.out, AllOf(StartsWith("press under energy-limited-spring: settled"),
                               HasSubstr("equal to the recording, bit for bit")));
  ASSERT_EQ(hapticwall({"run", "a.toml", "--csv", "c.csv", "--quiet"}).status, 0);
  EXPECT_TRUE(content("a.csv") == content("b.csv") && content("a.csv") == content("c.csv"));
  for (const char* sidecar : {"b.toml", "c.toml"}) {
    EXPECT_THAT(content(sidecar), AllOf(HasSubstr("name = \"energy-limited-spring\""),
                                        Not(HasSubstr("bookkeeping"))));
  }
  const Answer compared = hapticwall({"compare", "a.toml", "--algorithms",
                                      "energy-bookkeeping,none", "--sort", "none", "--json", "-"});
  EXPECT_EQ(nlohmann::json::parse(compared.out).at(0)["algorithm"], "energy-limited-spring");
}

TEST_F(ReplayCommand, SoDoTheyWhereThePointerLed) {
  record_led();
  ASSERT_EQ(
      hapticwall({"replay", "a.csv", "--algorithm", "energy-bounding", "--csv", "b.csv"}).status,
      0);
  const std::string again = content("b.csv");
  // The script's speed has more digits than its positions: the bytes differ from the script's run,
  // but equal any later re-run of this hand.
  ASSERT_EQ(
      hapticwall({"replay", "b.csv", "--algorithm", "energy-bounding", "--csv", "c.csv"}).status,
      0);
  EXPECT_TRUE(again == content("c.csv"));
  EXPECT_THAT(content("b.toml"), AllOf(HasSubstr("repeatable = false"),
                                       HasSubstr("the pointer led the hand in a.csv")));
}

TEST_F(ReplayCommand, UnderAnotherAlgorithmItIsWhatRunGives) {
  record();
  const Answer answer =
      hapticwall({"replay", "a.csv", "--algorithm", "none", "--csv", "b.csv", "--json", "b.json"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, AllOf(StartsWith("press under none: oscillating"),
                                HasSubstr("differs from the recording from tick 69")));
  ASSERT_EQ(
      hapticwall({"run", "a.toml", "--algorithm", "none", "--csv", "c.csv", "--quiet"}).status, 0);
  EXPECT_TRUE(content("b.csv") == content("c.csv"));
  ASSERT_EQ(hapticwall({"run", "b.toml", "--csv", "d.csv", "--quiet"}).status, 0);
  EXPECT_TRUE(content("b.csv") == content("d.csv"));
  EXPECT_EQ(nlohmann::json::parse(content("b.json"))["algorithm"], "none");
}

TEST_F(ReplayCommand, ARerunHasTheSignalsOfItsOwnAlgorithmIfTheRecordingHasSome) {
  const auto names_of_rerun = [&](const std::vector<std::string>& more) {
    record(more);
    EXPECT_EQ(
        hapticwall({"replay", "a.csv", "--algorithm", "force-bounding", "--csv", "b.csv"}).status,
        0);
    const std::string rows = content("b.csv");
    return rows.substr(0, rows.find('\n'));
  };
  EXPECT_THAT(names_of_rerun({}), ::testing::Not(HasSubstr("signal.")));
  EXPECT_THAT(names_of_rerun({"--signals"}),
              ::testing::EndsWith(",signal.gathered_energy_j,signal.force_bound_n"));
}

TEST_F(ReplayCommand, OtherKeysToo) {
  record();
  const Answer answer = hapticwall({"replay", "a.csv", "--algorithm", "none", "--set",
                                    "wall.stiffness_n_per_m=500", "--expect", "verdict=settled"});
  EXPECT_EQ(answer.status, 0) << answer.err << answer.out;
}

TEST_F(ReplayCommand, DrawsAFigure) {
  record();
  ASSERT_EQ(hapticwall({"replay", "a.csv", "--plot", "a.png", "--quiet"}).status, 0);
  EXPECT_GT(size("a.png"), 10'000U);
  ASSERT_EQ(
      hapticwall({"replay", "a.csv", "--algorithm", "none", "--plot", "b.png", "--quiet"}).status,
      0);
  EXPECT_GT(size("b.png"), 10'000U);
  EXPECT_THAT(files(), ElementsAre("a.csv", "a.png", "a.toml", "b.png"));
}

TEST_F(ReplayCommand, NotesAreToldAndQuietIsQuiet) {
  record();
  std::filesystem::remove(path("a.toml"));
  const Answer answer = hapticwall({"replay", "a.csv", "--json", "-"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.err,
            "note: a.csv: no sidecar a.toml: scene, walls and algorithm are not known\n");
  EXPECT_EQ(nlohmann::json::parse(answer.out)["algorithm"], "unknown");
  EXPECT_THAT(hapticwall({"replay", "a.csv", "--quiet"}).err, IsEmpty());
}

TEST_F(ReplayCommand, ARecordingThatBeganWhileThePointerLedSaysSo) {
  record_led();
  replace_in("a.toml", "first_tick = 0", "first_tick = 1000");
  std::string csv = content("a.csv");
  const std::size_t row = csv.find("\n1000,");
  csv.erase(csv.find('\n'), row - csv.find('\n'));
  put("a.csv", csv);
  const Answer answer = hapticwall({"replay", "a.csv", "--algorithm", "none", "--json", "-"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("SHA-256 differs"), HasSubstr("begins at tick 1000")));
}

TEST_F(ReplayCommand, ADevicesRecordingIsShownAndNotRerun) {
  put("d.csv",
      "tick,time_s,position_m,velocity_m_per_s,penetration_m,wall_force_n,force_n,stiffness_n_per_"
      "m,"
      "energy_cv_j,energy_hold_j,energy_scv_j,energy_budget_j,flags,device_time_s,read_age_s\n"
      "0,0,0.05,0,0,0,0,0,0,0,0,0,0,0,0.0001\n");
  EXPECT_EQ(hapticwall({"replay", "d.csv", "--quiet", "--expect", "ticks=1"}).status, 0);
}

TEST_F(ReplayCommand, AFullDiskIsAnErrorOfTheFile) {
  record();
  const Answer answer =
      shell("ulimit -f 100; \"$P\" replay a.csv --algorithm none --csv b.csv --quiet");
  EXPECT_EQ(answer.status, 4);
  EXPECT_THAT(answer.err, HasSubstr("error: b.csv"));
  EXPECT_THAT(files(), Not(::testing::Contains("b.csv")));
}

TEST_F(ReplayCommand, TheWindowNeedsADisplay) {
  record();
  const Answer answer = shell("unset DISPLAY WAYLAND_DISPLAY; \"$P\" replay a.csv");
  EXPECT_EQ(answer.status, 3);
  EXPECT_THAT(answer.err, HasSubstr("error: no window"));
  EXPECT_THAT(answer.err, HasSubstr("`hapticwall run` and `replay --json -` need no display"));
}

}  // namespace
}  // namespace hapticwall::command::test
