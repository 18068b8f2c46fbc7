// `run`, `compare` and `scenes` in a script: files, exit status, standard output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "hapticwall_version.h"
#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class Program : public ProgramTest {
 protected:
  static std::ptrdiff_t lines(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  }
};

TEST_F(Program, HelpAndVersion) {
  const Answer help = hapticwall({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.err, IsEmpty());
  EXPECT_THAT(help.out, AllOf(HasSubstr("Examples:"), HasSubstr("Exit status:"),
                              HasSubstr("compare"), HasSubstr("energy-bounding")));
  const Answer run_help = hapticwall({"run", "--help"});
  EXPECT_EQ(run_help.status, 0);
  EXPECT_THAT(run_help.out, AllOf(HasSubstr("hapticwall run [OPTIONS] SCENE"), HasSubstr("--csv")));
  const Answer version = hapticwall({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, StartsWith("hapticwall " + std::string(kVersion) + " ("));
}

TEST_F(Program, ListsTheScenes) {
  const Answer answer = hapticwall({"scenes"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(lines(answer.out), 13);
  EXPECT_THAT(answer.out, HasSubstr("\npress             A firm hand"));
}

TEST_F(Program, RunPrintsASummary) {
  const Answer answer = hapticwall({"run", "press"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.err, IsEmpty());
  EXPECT_THAT(answer.out, AllOf(StartsWith("press under energy-bounding: settled\n"),
                                HasSubstr("kN/m"), HasSubstr("6000 ticks")));
  EXPECT_THAT(hapticwall({"run", "press", "--quiet"}).out, IsEmpty());
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Program, TellsThatTheHandIsStillOnItsWay) {
  constexpr const char* kNote = "the hand's script still moves in the last second";
  EXPECT_THAT(hapticwall({"run", "press"}).out, Not(HasSubstr(kNote)));
  const Answer answer = hapticwall({"run", "press", "--duration", "0.3", "--csv", "a.csv"});
  EXPECT_THAT(answer.out, AllOf(HasSubstr("  whole run  "), HasSubstr(kNote)));
  EXPECT_THAT(hapticwall({"replay", "a.csv", "--json", "a.json"}).out, HasSubstr(kNote));
  EXPECT_THAT(hapticwall({"replay", "a.csv", "--algorithm", "none", "--json", "b.json"}).out,
              HasSubstr(kNote));
}

TEST_F(Program, IdenticalRunsGiveIdenticalBytesAndTheSidecarRepeatsThem) {
  ASSERT_EQ(hapticwall({"run", "press", "--csv", "a.csv", "--quiet"}).status, 0);
  ASSERT_EQ(hapticwall({"run", "press", "--csv", "b.csv", "--quiet"}).status, 0);
  ASSERT_EQ(hapticwall({"run", "a.toml", "--csv", "c.csv", "--quiet"}).status, 0);
  EXPECT_THAT(files(), ElementsAre("a.csv", "a.toml", "b.csv", "b.toml", "c.csv", "c.toml"));
  const std::string csv = content("a.csv");
  EXPECT_EQ(lines(csv), 6001);
  EXPECT_EQ(csv.find("nan"), std::string::npos);
  EXPECT_TRUE(csv == content("b.csv"));
  EXPECT_TRUE(csv == content("c.csv"));
  EXPECT_EQ(content("a.toml"), content("b.toml"));
  EXPECT_EQ(content("a.toml"), content("c.toml"));
}

TEST_F(Program, ASidecarWithChangesIsRepeatedFromItsFirstRow) {
  ASSERT_EQ(hapticwall({"run", "press", "--csv", "a.csv", "--quiet"}).status, 0);
  replace_in("a.toml", "first_tick = 0", "first_tick = 1000");
  put("s.toml", content("a.toml") +
                    "\n[[recording.change]]\ntick = 2000\n[recording.change.algorithm]\n"
                    "name = \"none\"\n[[recording.change.wall]]\nposition_m = 0.05\n"
                    "stiffness_n_per_m = 35000.0\n");
  ASSERT_EQ(hapticwall({"run", "s.toml", "--csv", "b.csv", "--quiet"}).status, 0);
  ASSERT_EQ(hapticwall({"run", "b.toml", "--csv", "c.csv", "--quiet"}).status, 0);
  const std::string changed = content("b.csv");
  EXPECT_EQ(lines(changed), 5001);
  EXPECT_THAT(changed.substr(changed.find('\n') + 1), StartsWith("1000,1,"));
  EXPECT_TRUE(changed == content("c.csv"));
  EXPECT_EQ(content("b.toml"), content("c.toml"));
  // The rows are the same until the change; then another algorithm oscillates.
  const std::string original = content("a.csv");
  const std::string row_1999 = original.substr(original.find("\n1999,"), 200);
  EXPECT_THAT(changed, HasSubstr(row_1999));
  EXPECT_EQ(hapticwall({"run", "s.toml", "--quiet", "--expect", "verdict=oscillating"}).status, 0);
}

TEST_F(Program, SettingsReachTheRun) {
  const Answer answer = hapticwall({"run", "press", "--algorithm", "none", "--duration", "2",
                                    "--set", "sampling.rate_hz=2000", "--json", "-"});
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json.at("algorithm"), "none");
  EXPECT_EQ(json.at("ticks"), 4000);
  EXPECT_EQ(json.at("duration_s"), 2.0);
}

TEST_F(Program, JsonOnStandardOutputIsAllThereIs) {
  const Answer answer = hapticwall({"run", "press", "--json", "-"});
  EXPECT_EQ(answer.status, 0);
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json.at("verdict"), "settled");
  EXPECT_TRUE(json.at("ns_per_tick").is_number());
  const Answer compared = hapticwall({"compare", "press", "--json", "-", "--quiet"});
  EXPECT_EQ(nlohmann::json::parse(compared.out).size(), algorithms().size() + 2);
}

TEST_F(Program, JsonFile) {
  ASSERT_EQ(hapticwall({"run", "press", "--json", "a.json"}).status, 0);
  EXPECT_EQ(nlohmann::json::parse(content("a.json")).at("scene"), "press");
  EXPECT_THAT(files(), ElementsAre("a.json"));
}

TEST_F(Program, ExpectationsDecideTheStatus) {
  EXPECT_EQ(hapticwall({"run", "press", "--expect", "verdict=settled", "--expect",
                        "tail_peak_to_peak_m<1e-4", "--quiet"})
                .status,
            0);
  const Answer unmet = hapticwall({"run", "press", "--expect", "verdict=diverged", "--quiet"});
  EXPECT_EQ(unmet.status, 1);
  EXPECT_EQ(unmet.err,
            "expected verdict=diverged, found verdict = settled (press under energy-bounding)\n");
  const Answer compared =
      hapticwall({"compare", "press", "--algorithms", "none,energy-bounding,half-sample",
                  "--expect", "verdict=settled", "--quiet"});
  EXPECT_EQ(compared.status, 1);
  EXPECT_EQ(compared.error_lines(), 2) << compared.err;
}

TEST_F(Program, CompareIsATable) {
  const Answer answer =
      hapticwall({"compare", "press", "--algorithms", "none,energy-bounding", "--csv", "t.csv"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(lines(answer.out), 6);  // two of the heading, two below that explain its marks
  EXPECT_THAT(answer.out, AllOf(HasSubstr("\nnone             oscillating"),
                                HasSubstr("\nenergy-bounding  settled")));
  EXPECT_EQ(lines(content("t.csv")), 3);
  EXPECT_THAT(content("t.csv"), AllOf(StartsWith("scene,algorithm,verdict,"),
                                      HasSubstr("\npress,none,oscillating,6,6000,")));
}

TEST_F(Program, ADivergedRunEndsInOrder) {
  // A wall damper far beyond what a sampled loop can hold, and no force limit to speak of.
  const Answer answer = hapticwall(
      {"run", "light", "--algorithm", "none", "--set", "wall.damping_n_s_per_m=1e4", "--set",
       "device.encoder_m=0", "--set", "device.force_limit_n=1e6", "--csv", "a.csv", "--json", "-"});
  EXPECT_EQ(answer.status, 0) << answer.err;
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json.at("verdict"), "diverged");
  const std::string csv = content("a.csv");
  EXPECT_EQ(lines(csv), 1 + json.at("diverged_at_tick").get<std::ptrdiff_t>());
  EXPECT_EQ(csv.find("nan") + 1 + csv.find("inf") + 1, 0U);
  const Answer again =
      hapticwall({"run", "a.toml", "--csv", "b.csv", "--quiet", "--expect", "verdict=diverged"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_TRUE(csv == content("b.csv"));
  EXPECT_EQ(content("a.toml"), content("b.toml"));
}

TEST_F(Program, AFullDiskOnStandardOutputIsStatusFour) {
  EXPECT_EQ(shell("exec $P scenes > /dev/full").status, 4);
}

TEST_F(Program, AStudyThatIsEndedEarlyWritesNothing) {
  const std::vector<std::vector<std::string>> commands{
      {"accuracy", "press", "--duration", "10000", "--json", "a.json", "--csv", "a.csv"},
      {"compare", "press", "--study", "--duration", "10000", "--json", "a.json", "--csv", "a.csv"},
      {"compare", "press", "--set", "simulator.integrator=rk4", "--set", "simulator.substeps=1000",
       "--duration", "100", "--plot", "a.png", "--quiet"}};
  for (const std::vector<std::string>& command : commands) {
    for (const auto& [signal, name] : {std::pair{SIGINT, "Ctrl-C"}, {SIGTERM, "SIGTERM"}}) {
      const Answer answer = interrupted(command, signal);
      EXPECT_EQ(answer.status, 128 + signal);
      EXPECT_EQ(answer.err, "ended early by " + std::string(name) + "; nothing was written\n");
      EXPECT_THAT(answer.out, IsEmpty());
      EXPECT_THAT(files(), IsEmpty());
    }
  }
}

// A tick of 1000 substeps takes many of its periods.
TEST_F(Program, ASlowRealTimeRunEndsEarlyWithAWholeRecording) {
  const pid_t child = start({program(), "run", "press", "--realtime", "--set",
                             "simulator.integrator=rk4", "--set", "simulator.substeps=1000",
                             "--set", "sampling.rate_hz=1e5", "--csv", "a.csv", "--quiet"});
  wait_until_written(child, "a.csv.partial", 10'000);  // 10,000 bytes: some rows
  kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child).status, 128 + SIGTERM);
  ASSERT_EQ(hapticwall({"run", "a.toml", "--csv", "b.csv", "--quiet"}).status, 0);
  EXPECT_TRUE(content("a.csv") == content("b.csv"));
}

TEST_F(Program, AReaderThatLeavesIsNoError) {
  const Answer answer = shell("{ $P compare press; echo status $? >&2; } | true");
  EXPECT_EQ(answer.err, "status 0\n");
}

// The figure of a run is drawn while nothing else is: it needs no display.
TEST_F(Program, PlotWritesAPicture) {
  const Answer answer = hapticwall({"run", "press", "--plot", "a.png", "--quiet"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(content("a.png"), StartsWith("\x89PNG\r\n"));
  EXPECT_THAT(files(), ElementsAre("a.png"));
}

TEST_F(Program, TheEndingOfPlotIsItsFormat) {
  for (const auto& [name, start] :
       {std::pair{"a.svg", "<?xml"}, {"b.SVG", "<?xml"}, {"c.pdf", "%PDF-"}, {"d", "\x89PNG"}}) {
    const Answer answer = hapticwall({"run", "press", "--plot", name, "--quiet"});
    ASSERT_EQ(answer.status, 0) << answer.err;
    EXPECT_THAT(content(name), StartsWith(start)) << name;
  }
  EXPECT_THAT(files(), ElementsAre("a.svg", "b.SVG", "c.pdf", "d"));
  for (const char* name : {"a.svg", "c.pdf"}) {
    const std::string before = content(name);
    ASSERT_EQ(hapticwall({"run", "press", "--plot", name, "--quiet"}).status, 0);
    EXPECT_TRUE(content(name) == before) << name;
  }
}

TEST_F(Program, CtrlCEndsItWithItsFilesWhole) {
  for (const auto& [signal, in_real_time] :
       {std::pair{SIGINT, false}, {SIGTERM, false}, {SIGINT, true}, {SIGTERM, true}}) {
    std::vector<std::string> line{program(), "run",   "press",  "--duration", "100000",
                                  "--csv",   "a.csv", "--json", "a.json"};
    if (in_real_time) line.emplace_back("--realtime");
    const pid_t child = start(line);
    wait_until_written(child, "a.csv.partial");
    kill(child, signal);
    const Answer answer = wait_for(child);
    EXPECT_EQ(answer.status, 128 + signal);
    EXPECT_THAT(answer.err, AllOf(StartsWith("ended early by "), HasSubstr("a.csv holds these")));
    EXPECT_EQ(answer.error_lines(), 1);
    EXPECT_THAT(answer.out, IsEmpty());
    EXPECT_THAT(files(), ElementsAre("a.csv", "a.toml"));
    EXPECT_THAT(content("a.toml"), HasSubstr("complete = true"));
    const std::string csv = content("a.csv");
    const auto rows = std::count(csv.begin(), csv.end(), '\n') - 1;
    EXPECT_THAT(answer.err, HasSubstr(" after " + std::to_string(rows) + " of "));
    ASSERT_EQ(hapticwall({"run", "a.toml", "--csv", "b.csv", "--quiet"}).status, 0);
    EXPECT_TRUE(content("a.csv") == content("b.csv"));
    remove_files();
  }
}

TEST_F(Program, RealTimeRunsAreRepeatedBitForBit) {
  const Answer answer = hapticwall({"run", "press", "--realtime", "--duration", "0.2", "--set",
                                    "device.start_m=0.0499", "--csv", "a.csv", "--json", "a.json"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("real time"));
  EXPECT_EQ(nlohmann::json::parse(content("a.json")).at("ticks"), 200);
  EXPECT_EQ(lines(content("a.csv")), 201);
  EXPECT_THAT(content("a.toml"), HasSubstr("start_time = "));
  ASSERT_EQ(hapticwall({"run", "a.toml", "--csv", "b.csv", "--quiet"}).status, 0);
  EXPECT_TRUE(content("a.csv") == content("b.csv"));
}

// A very light hand on a very stiff grip, with friction.
void add_tick_of_too_much_work(std::vector<std::string>& line) {
  for (const char* set :
       {"sampling.rate_hz=228.918", "device.mass_kg=0.0145", "device.damping_n_s_per_m=0.02",
        "device.friction_n=0.004", "device.encoder_m=0", "wall.stiffness_n_per_m=100",
        "hand.mass_kg=3.25e-6", "hand.stiffness_n_per_m=7200", "hand.damping_n_s_per_m=21",
        "hand.grip_stiffness_n_per_m=3.18e6", "hand.grip_damping_n_s_per_m=3700"}) {
    line.insert(line.end(), {"--set", set});
  }
}

TEST_F(Program, ATickThatIsTooMuchWorkIsRefusedInARunAndInRealTime) {
  std::vector<std::string> line{"run", "press", "--algorithm", "none", "--quiet"};
  add_tick_of_too_much_work(line);
  for (int i = 0; i < 2; ++i) {
    const Answer answer = hapticwall(line);
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(answer.err, HasSubstr("is too much work for the exact integrator"));
    EXPECT_EQ(answer.error_lines(), 1);
    line.emplace_back("--realtime");
  }
}

TEST_F(Program, AMapNamesTheCellThatItRefuses) {
  std::vector<std::string> line{"map", "press", "--algorithms", "none", "--quiet"};
  add_tick_of_too_much_work(line);
  for (const char* word : {"--x", "hand.mass_kg=3.25e-6:0.3:2", "--y",
                           "device.friction_n=0:0.004:2", "--csv", "a.csv"}) {
    line.emplace_back(word);
  }
  const Answer answer = hapticwall(line);
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, StartsWith("error: the cell hand.mass_kg=3.25e-6, "
                                     "device.friction_n=0.004: tick "));
  EXPECT_EQ(answer.error_lines(), 1);
}

}  // namespace
}  // namespace hapticwall::command::test
