// Algorithms from shared libraries, by the whole program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

constexpr const char* kBuiltIn = "energy-bounding";

std::string library(const std::string& name) {
  return hapticwall::test::plugin_folder() + "/" + name + ".so";
}

std::string replaced(std::string text, const std::string& piece, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(piece, at)) != std::string::npos; at += by.size())
    text.replace(at, piece.size(), by);
  return text;
}

class PluginTest : public ProgramTest {
 protected:
  Answer done(std::vector<std::string> arguments) const {
    Answer answer = hapticwall(std::move(arguments));
    EXPECT_EQ(answer.status, 0) << answer.err;
    return answer;
  }
  [[nodiscard]] std::vector<std::vector<std::string>> table(const std::string& name) const {
    std::vector<std::vector<std::string>> rows;
    std::istringstream text(content(name));
    for (std::string line; std::getline(text, line);) {
      std::istringstream fields(line);
      rows.emplace_back();
      for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
    }
    return rows;
  }
  // The tables of a.csv and b.csv without names and times.
  void expect_same_accuracy() const {
    const std::set<std::string> differs{"algorithm", "ns_per_tick", "ratio_to_exact", "set_up_ns"};
    const auto a = table("a-accuracy.csv");
    const auto b = table("b-accuracy.csv");
    ASSERT_EQ(a.size(), b.size());
    ASSERT_GT(a.size(), 2U);
    for (std::size_t row = 0; row < a.size(); ++row) {
      for (std::size_t i = 0; i < a[row].size(); ++i) {
        if (!differs.contains(a[0][i])) EXPECT_EQ(a[row][i], b[row].at(i)) << a[0][i];
      }
    }
  }
  // Exit status 2, one line, and no file.
  void expect_refused(const std::string& path, const std::string& reason) const {
    const Answer answer =
        hapticwall({"run", "tap", "--algorithm", path, "--csv", "refused.csv", "--quiet"});
    EXPECT_EQ(answer.status, 2) << path;
    EXPECT_THAT(answer.err, HasSubstr(reason));
    EXPECT_EQ(answer.error_lines(), 1) << answer.err;
    EXPECT_EQ(size("refused.csv"), 0U);
  }
};

// The examples are the built-in algorithm a second time.
class PluginExampleTest : public PluginTest, public ::testing::WithParamInterface<const char*> {
 protected:
  [[nodiscard]] static std::string language() { return GetParam(); }
  [[nodiscard]] static std::string example() { return library("bounding_" + language()); }
};
INSTANTIATE_TEST_SUITE_P(Languages, PluginExampleTest, ::testing::Values("c", "cpp"));

TEST_P(PluginExampleTest, RunsWithTheBitsOfTheBuiltInAlgorithm) {
  for (const std::string scene : {"press", "corner", "golden-soft-fric"}) {
    done({"run", scene, "--algorithm", kBuiltIn, "--signals", "--csv", "a.csv"});
    done({"run", scene, "--algorithm", example(), "--signals", "--csv", "b.csv"});
    EXPECT_GT(size("a.csv"), 1000U);
    EXPECT_THAT(table("a.csv").front().back(), HasSubstr("signal.step_bound_n"));
    EXPECT_EQ(content("a.csv"), content("b.csv")) << scene;
  }
}

TEST_P(PluginExampleTest, TakesItsKeysByNameBesideTheBuiltInAlgorithm) {
  const std::string key = "algorithm.rest_force_step_n=0.001";
  done({"run", "press", "--algorithm", kBuiltIn, "--set", key, "--csv", "a.csv"});
  done({"run", "press", "--algorithm", example(), "--set", key, "--csv", "b.csv"});
  done({"run", "press", "--algorithm", example(), "--csv", "c.csv"});
  EXPECT_EQ(content("a.csv"), content("b.csv"));
  EXPECT_NE(content("a.csv"), content("c.csv"));
  EXPECT_EQ(hapticwall({"run", "press", "--algorithm", example(), "--set",
                        "algorithm.rest_force_step_n=-1"})
                .status,
            2);
}

TEST_P(PluginExampleTest, IsARowOfAComparisonAndOfAMap) {
  const std::string both = std::string(kBuiltIn) + "," + example();
  done({"compare", "press", "--algorithms", both, "--csv", "rows.csv"});
  done({"map", "press", "--x", "wall.stiffness_n_per_m=1e3:1e5:3:log", "--y",
        "algorithm.rest_force_step_n=0.001:0.1:3:log", "--algorithms", kBuiltIn, "--csv", "a.csv"});
  done({"map", "press", "--x", "wall.stiffness_n_per_m=1e3:1e5:3:log", "--y",
        "algorithm.rest_force_step_n=0.001:0.1:3:log", "--algorithms", example(), "--csv",
        "b.csv"});
  const std::string name = "bounding-" + language();
  EXPECT_EQ(content("a.csv"), replaced(content("b.csv"), name, kBuiltIn));
  const std::string rows = content("rows.csv");
  const std::size_t plugin = rows.find('\n' + name) + 1;
  const std::size_t built_in = rows.find('\n' + std::string(kBuiltIn)) + 1;
  const auto line = [&](std::size_t at) { return rows.substr(at, rows.find('\n', at) - at); };
  EXPECT_EQ(line(built_in), replaced(line(plugin), name, kBuiltIn));
  EXPECT_THAT(content("b.toml"), HasSubstr("plugins = "));
}

TEST_P(PluginExampleTest, IsMeasuredAndStudied) {
  const std::string name = "bounding-" + language();
  for (const std::string& algorithm : {std::string(kBuiltIn), example()}) {
    const std::string file = algorithm == kBuiltIn ? "a" : "b";
    done({"compare", "tap", "--study", "--algorithms", algorithm, "--duration", "1", "--csv",
          file + "-study.csv"});
    done({"accuracy", "golden-soft", "--algorithm", algorithm, "--duration", "0.2", "--quiet",
          "--csv", file + "-accuracy.csv"});
  }
  EXPECT_EQ(content("a-study.csv"), replaced(content("b-study.csv"), name, kBuiltIn));
  EXPECT_GT(size("a-study.csv"), 100U);
  expect_same_accuracy();
}

TEST_P(PluginExampleTest, RerunsARecordedHandBitForBit) {
  done({"run", "press", "--algorithm", example(), "--signals", "--csv", "a.csv"});
  const Answer rerun = done({"replay", "a.csv", "--algorithm", example(), "--csv", "b.csv"});
  EXPECT_THAT(rerun.out, HasSubstr("equal to the recording, bit for bit"));
  done({"run", "a.toml", "--algorithm", example(), "--signals", "--csv", "c.csv"});
  EXPECT_EQ(content("a.csv"), content("b.csv"));
  EXPECT_EQ(content("a.csv"), content("c.csv"));
  EXPECT_THAT(content("a.toml"), HasSubstr("plugin_sha256 = \""));
}

// The follower's signals stand beside those of the plug-in.
TEST_F(PluginTest, HasColumnsForItsOwnSignals) {
  done({"run", "tap", "--algorithm", library("plugin_sound"), "--set",
        "algorithm.then=passivity-control", "--duration", "0.01", "--signals", "--csv", "a.csv",
        "--stream", "a.jsonl"});
  const std::vector<std::vector<std::string>> rows = table("a.csv");
  ASSERT_EQ(rows.size(), 11U);
  const std::size_t ticks = rows.front().size() - 4;
  EXPECT_EQ(rows.front()[ticks], "signal.ticks");
  EXPECT_EQ(rows.front()[ticks + 1], "signal.observed_energy_j");
  for (std::size_t row = 1; row < rows.size(); ++row)
    EXPECT_EQ(rows[row][ticks], std::to_string(row - 1));
  EXPECT_THAT(content("a.jsonl"), HasSubstr("\"signal.ticks\":9,\"signal.observed_energy_j\":0,"));
  // The signals keep their names without the plug-in.
  done({"replay", "a.csv", "--stream", "b.jsonl"});
  EXPECT_EQ(content("a.jsonl"), content("b.jsonl"));
}

TEST_F(PluginTest, RefusesInASentenceWhatIsNoPlugin) {
  put("notes.so", "this is a text\n");
  expect_refused("./notes.so", "./notes.so: no plug-in: ");
  expect_refused("./", "./: not a plug-in: not a file");
  expect_refused("./absent.so", "./absent.so: cannot be read");
  expect_refused(library("plugin_missing"), "it exports no hapticwall_plugin");
  expect_refused(library("plugin_abi"), "built for ABI 7, this program has ABI 1");
  expect_refused(library("plugin_size"), "its hw_plugin has 8 bytes");
  expect_refused(library("plugin_range"), "parameter unused: minimum and maximum");
  expect_refused(library("plugin_shared"), "another algorithm has this key with another unit");
}

TEST_F(PluginTest, IsAPathAndNeverAName) {
  std::filesystem::copy(library("plugin_sound"), path("mine.so"));
  expect_refused("mine.so", "unknown algorithm");
  done({"run", "tap", "--algorithm", "./mine.so"});
}

// Two equal axes, which the program runs in turns of many ticks.
TEST_F(PluginTest, KeepsAStateForEachAxis) {
  done({"run", "corner", "--algorithm", library("plugin_memory"), "--set",
        "hand.y.path=[[0.0, 0.03], [1.5, 0.075]]", "--set", "wall[1].stiffness_n_per_m=35000",
        "--csv", "a.csv"});
  const std::vector<std::vector<std::string>> rows = table("a.csv");
  ASSERT_GT(rows.size(), 1000U);
  const std::vector<std::string>& names = rows.front();
  std::size_t compared = 0;
  for (std::size_t x = 0; x < names.size(); ++x) {
    const auto y = std::find(names.begin(), names.end(), "y_" + names[x]);
    if (y == names.end()) continue;
    ++compared;
    for (const auto& row : rows) {
      if (&row == &rows.front()) continue;
      ASSERT_EQ(row[x], row[static_cast<std::size_t>(y - names.begin())]) << names[x];
    }
  }
  EXPECT_GT(compared, 5U);
}

// A key without effect: every row of the map is the same run, on another thread.
TEST_F(PluginTest, KeepsAStateForEachRun) {
  done({"map", "press", "--x", "algorithm.unused=0:1:16", "--y", "hand.mass_kg=0.3:0.4:2",
        "--algorithms", library("plugin_memory"), "--csv", "map.csv"});
  const std::vector<std::vector<std::string>> rows = table("map.csv");
  ASSERT_EQ(rows.size(), 33U);
  std::set<std::vector<std::string>> results;
  for (std::size_t i = 1; i < rows.size(); ++i)
    results.insert({rows[i].begin() + 2, rows[i].end()});
  EXPECT_EQ(results.size(), 2U);
}

TEST_F(PluginTest, GivesZeroForceForWhatIsNotFinite) {
  const Answer answer = hapticwall(
      {"run", "press", "--algorithm", library("plugin_nan"), "--csv", "a.csv", "--json", "a.json"});
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(content("a.json"), HasSubstr("\"diverged_at_tick\": 500"));
  EXPECT_THAT(content("a.toml"), HasSubstr("diverged_at_tick = 500"));
}

TEST_F(PluginTest, TellsOfAnExceptionAndKeepsTheRecording) {
  const Answer answer =
      hapticwall({"run", "press", "--algorithm", library("plugin_throws"), "--csv", "a.csv"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.err, HasSubstr("the plug-in test-throws threw an exception"));
  EXPECT_THAT(content("a.toml"), HasSubstr("diverged_at_tick = 500"));
}

TEST_F(PluginTest, TellsThatARecordingsPluginWasChanged) {
  std::filesystem::copy(library("bounding_c"), path("mine.so"));
  done({"run", "press", "--algorithm", "./mine.so", "--csv", "a.csv"});
  EXPECT_THAT(done({"run", "a.toml", "--algorithm", "./mine.so"}).err, Not(HasSubstr("changed")));
  put("mine.so", content("mine.so") + "x");
  EXPECT_THAT(done({"run", "a.toml", "--algorithm", "./mine.so"}).err,
              HasSubstr("./mine.so was changed since (SHA-256 differs)"));
  EXPECT_THAT(done({"replay", "a.csv", "--algorithm", "./mine.so", "--json", "-"}).err,
              HasSubstr("./mine.so was changed since (SHA-256 differs)"));
}

TEST_F(PluginTest, ASceneLoadsNoLibrary) {
  std::filesystem::copy(library("bounding_c"), path("mine.so"));
  done({"run", "press", "--algorithm", "./mine.so", "--csv", "a.csv"});
  const Answer again = hapticwall({"run", "a.toml"});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(
      again.err,
      HasSubstr("which a scene does not load; if you trust it, --algorithm ./mine.so does"));
  done({"run", "a.toml", "--algorithm", "none"});
  // The rows are shown without it.
  EXPECT_EQ(hapticwall({"replay", "a.csv", "--json", "-"}).status, 0);
  replace_in("a.toml", "name = \"bounding-c\"", "name = \"./mine.so\"");
  replace_in("a.toml", "plugin_file = \"./mine.so\"", "");
  EXPECT_THAT(hapticwall({"run", "a.toml"}).err,
              HasSubstr("is a file, which a scene does not load; if you trust it, --algorithm"));
}

// Code that another user can change would run with the rights of this one.
TEST_F(PluginTest, OfAnotherUserIsNotRun) {
  const std::string of_others = "another user can write it; copy it to a folder of yours";
  std::filesystem::copy(library("bounding_c"), path("mine.so"));
  const auto set_mode = [&](const std::string& name, mode_t mode) {
    ASSERT_EQ(chmod(path(name).c_str(), mode), 0);
  };
  set_mode("mine.so", 0757);
  expect_refused("./mine.so", of_others);
  set_mode("mine.so", 0755);
  set_mode("", 0777);
  expect_refused("./mine.so", "another user can write its folder");
  set_mode("", 01777);
  done({"run", "tap", "--algorithm", "./mine.so"});
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to make a file of another user";
  constexpr uid_t kNobody = 65534;
  ASSERT_EQ(chown(path("mine.so").c_str(), kNobody, 0), 0);
  expect_refused("./mine.so", of_others);
  ASSERT_EQ(chown(path("mine.so").c_str(), 0, kNobody), 0);
  done({"run", "tap", "--algorithm", "./mine.so"});
  set_mode("mine.so", 0775);
  expect_refused("./mine.so", of_others);
}

TEST_F(PluginTest, IsNotReplacedByAnOutput) {
  std::filesystem::copy(library("bounding_c"), path("mine.so"));
  const std::string before = content("mine.so");
  const Answer answer =
      hapticwall({"run", "tap", "--algorithm", "./mine.so", "--json", "mine.so", "--quiet"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_EQ(answer.err,
            "error: --json 'mine.so': it would replace an input file; choose another name\n");
  EXPECT_TRUE(content("mine.so") == before);
}

TEST_F(PluginTest, DrivesADeviceOnlyOnRequest) {
  const std::vector<std::string> arguments{
      "run", "tap", "--algorithm", library("bounding_c"), "--device", "ie2000", "--quiet"};
  const Answer refused = hapticwall(arguments);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("only with --allow-plugin"));
  std::vector<std::string> allowed = arguments;
  allowed.emplace_back("--allow-plugin");
  EXPECT_THAT(hapticwall(allowed).err, Not(HasSubstr("--allow-plugin")));
}

}  // namespace
}  // namespace hapticwall::command::test
