// A measured hand (`hand.path_file`) and a recorded one (NAME.csv as SCENE) in all commands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kMapAxes{"--x", "wall.stiffness_n_per_m=1000:35000:2", "--y",
                                        "device.damping_n_s_per_m=0.5:1:2"};

class MeasuredHand : public ProgramTest {
 protected:
  // 60 s of a tremor at 1 kHz, or its beginning.
  void put_hand(int points = 60'000) const {
    std::string text = "time_s,position_m\n";
    for (int i = 0; i < points; ++i) {
      const double time_s = i / 1000.0;
      text +=
          std::to_string(time_s) + "," +
          std::to_string(0.055 + 0.004 * std::sin(9.0 * time_s) + 1e-4 * std::sin(60 * time_s)) +
          "\n";
    }
    put("hand.csv", text);
  }
  [[nodiscard]] Answer on_hand(std::vector<std::string> command,
                               const std::vector<std::string>& more) const {
    command.insert(command.end(), {"press", "--set", "hand.path_file=hand.csv"});
    command.insert(command.end(), more.begin(), more.end());
    return hapticwall(std::move(command));
  }
};

TEST_F(MeasuredHand, OfAMinuteRunsInEveryCommand) {
  put_hand();
  const std::vector<std::string> whole{"--duration", "60", "--quiet", "--json", "-"};
  const Answer run = on_hand({"run"}, whole);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["ticks"], 60'000);
  const Answer compared = on_hand({"compare"}, whole);
  ASSERT_EQ(compared.status, 0) << compared.err;
  for (const Json& row : Json::parse(compared.out)) {
    if (row["algorithm"] != "energy-bounding") continue;
    EXPECT_EQ(row["energy_scv_j"], Json::parse(run.out)["energy_scv_j"]);
  }
  std::vector<std::string> map = kMapAxes;
  map.insert(map.end(), whole.begin(), whole.end());
  map.insert(map.end(), {"--algorithms", "energy-bounding", "--csv", "m.csv"});
  const Answer mapped = on_hand({"map"}, map);
  ASSERT_EQ(mapped.status, 0) << mapped.err;
  EXPECT_EQ(Json::parse(mapped.out)["cells"], 4);
  EXPECT_THAT(content("m.toml"), HasSubstr("path_file = \"hand.csv\"\npath_sha256 = "));
  EXPECT_EQ(on_hand({"accuracy"}, {"--duration", "1", "--substeps", "2", "--quiet"}).status, 0);
}

TEST_F(MeasuredHand, ItsSidecarRepeatsTheRunAndTellsAChangedFile) {
  put_hand(500);
  std::filesystem::create_directory(path("out"));
  ASSERT_EQ(on_hand({"run"}, {"--duration", "0.5", "--csv", "out/a.csv", "--quiet"}).status, 0);
  const Answer again = hapticwall({"run", "out/a.toml", "--csv", "b.csv", "--json", "-"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.err, "");
  EXPECT_TRUE(content("out/a.csv") == content("b.csv"));
  put_hand(400);
  const Answer other = hapticwall({"run", "out/a.toml", "--csv", "c.csv", "--json", "-"});
  EXPECT_EQ(other.status, 0);
  EXPECT_EQ(other.error_lines(), 1);
  EXPECT_THAT(other.err, AllOf(StartsWith("note: the run will differ from the recorded session: "),
                               EndsWith("hand.csv was changed since (SHA-256 differs)\n")));
  EXPECT_FALSE(content("out/a.csv") == content("c.csv"));
  const Answer compared = hapticwall({"compare", "out/a.toml"});
  EXPECT_EQ(compared.status, 2);
  EXPECT_THAT(compared.err, HasSubstr("'compare NAME.csv' re-runs the recorded hand"));
  // The rows have the hand of old.
  ASSERT_EQ(hapticwall({"replay", "out/a.csv", "--algorithm", "energy-bounding", "--csv", "d.csv"})
                .status,
            0);
  EXPECT_TRUE(content("out/a.csv").substr(0, 2000) == content("d.csv").substr(0, 2000));
}

TEST_F(MeasuredHand, DoesNotWaitForAPipe) {
  ASSERT_EQ(mkfifo(path("pipe.csv").c_str(), 0600), 0);
  const Answer answer = hapticwall({"run", "press", "--set", "hand.path_file=pipe.csv"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, EndsWith("hand.path_file: pipe.csv: not a hand: not a file\n"));
}

// a.csv: a session whose pointer led the hand along the rows, and whose sidecar has the script.
class RecordedHand : public ProgramTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(hapticwall({"run", "press", "--csv", "a.csv", "--quiet", "--duration", "3", "--set",
                          "hand.path=[[0, 0.03], [0.7003, 0.06], [1.4, 0.052]]"})
                  .status,
              0);
    const std::string sidecar = content("a.toml");
    const std::size_t path = sidecar.find("path = ");
    replace_in("a.toml", sidecar.substr(path, sidecar.find('\n', path) - path),
               "path = [[0.0, 0.03], [1.0, 0.09]]");
    replace_in("a.toml", "repeatable = true",
               "repeatable = false\nnot_repeatable_because = \"the pointer led the hand\"");
  }
  [[nodiscard]] Json rerun(const std::string& algorithm) const {
    const Answer answer =
        hapticwall({"replay", "a.csv", "--algorithm", algorithm, "--quiet", "--json", "-"});
    EXPECT_EQ(answer.status, 0) << answer.err;
    return Json::parse(answer.out);
  }
};

TEST_F(RecordedHand, ComparesAsReplayReRunsIt) {
  const Answer answer = hapticwall({"compare", "a.csv", "--json", "-", "--plot", "a.png"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.err, HasSubstr("note: a.csv: its recorded hand is re-run\n"));
  std::size_t same = 0;
  for (const Json& row : Json::parse(answer.out)) {
    const std::string label = row["algorithm"];
    if (label.find(' ') != std::string::npos) continue;  // another form
    EXPECT_EQ(row, rerun(label)) << label;
    ++same;
  }
  EXPECT_EQ(same, algorithms().size());
  EXPECT_GT(size("a.png"), 10'000U);
  EXPECT_NE(rerun("none")["true_hand_work_j"], rerun("energy-bounding")["true_hand_work_j"]);
}

TEST_F(RecordedHand, IsComparedAlsoWhereParametersChanged) {
  put("a.toml", content("a.toml") +
                    "[[recording.change]]\ntick = 1\n[[recording.change.wall]]\n"
                    "position_m = 0.05\nstiffness_n_per_m = 900.0\n");
  const Answer answer =
      hapticwall({"compare", "a.csv", "--algorithms", "half-sample,passivity-control", "--sort",
                  "none", "--quiet", "--json", "-"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const Json rows = Json::parse(answer.out);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0], rerun("half-sample"));
  EXPECT_EQ(rows[1], rerun("passivity-control"));
  EXPECT_NE(rows[1]["true_hand_work_j"], rows[3]["true_hand_work_j"]) << "another form";
}

// One cell has the recorded parameters.
TEST_F(RecordedHand, IsThatOfEveryCellOfAMap) {
  std::vector<std::string> command{"map",   "a.csv", "--algorithms", "none,energy-bounding",
                                   "--csv", "m.csv"};
  command.insert(command.end(), kMapAxes.begin(), kMapAxes.end());
  const Answer answer = hapticwall(command);
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.err, HasSubstr("note: a.csv: its recorded hand is re-run\n"));
  for (const std::string algorithm : {"none", "energy-bounding"}) {
    const Json recorded = rerun(algorithm);
    const std::string row = "\n" + algorithm + ",35000,1," + std::string(recorded["verdict"]) + ",";
    const std::size_t found = content("m.csv").find(row);
    ASSERT_NE(found, std::string::npos) << content("m.csv");
    EXPECT_EQ(std::stod(content("m.csv").substr(found + row.size())),
              recorded["tail_peak_to_peak_m"]);
  }
  EXPECT_THAT(content("m.toml"), HasSubstr("path_file = \"a.csv\"\npath_sha256 = "));
  const Answer rate = hapticwall({"map", "a.csv", "--x", "sampling.rate_hz=500:1000:2", "--y",
                                  "device.mass_kg=0.1:0.2:2", "--quiet"});
  EXPECT_EQ(rate.status, 2);
  EXPECT_THAT(rate.err, HasSubstr("the hand was recorded at 1000 Hz"));
}

TEST_F(RecordedHand, IsStudiedAndMeasured) {
  const std::string work = rerun("energy-bounding")["tail_peak_to_peak_m"].dump();
  Answer answer = hapticwall({"accuracy", "a.csv", "--substeps", "50", "--json", "-", "--quiet"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_EQ(Json::parse(answer.out)["rows"][0]["tail_peak_to_peak_m"].dump(), work);
  answer = hapticwall(
      {"compare", "a.csv", "--study", "--algorithms", "energy-bounding", "--json", "-", "--quiet"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_EQ(Json::parse(answer.out)["duration_s"], 3.0);
  EXPECT_TRUE(Json::parse(answer.out)["rows"][0]["rate_hardness_n_per_m"].is_number());
}

}  // namespace
}  // namespace hapticwall::command::test
