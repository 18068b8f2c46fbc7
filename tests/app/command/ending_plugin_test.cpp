// Plug-ins that end the process, hang, or change the rounding mode, by the whole program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

using ::testing::Values;

constexpr const char* kCommands = "HAPTICWALL_TEST_COMMANDS";

std::string algorithm(const std::string& act, const std::string& function) {
  return hapticwall::test::plugin_folder() + "/ending_algorithm_" + act + "_" + function + ".so";
}

class EndingPlugin : public ProgramTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override { setenv(kCommands, path("commands").c_str(), 1); }
  void TearDown() override { unsetenv(kCommands); }
  // A copy for this test: a device has one host, and tests run at the same time.
  [[nodiscard]] std::string device(const std::string& act, const std::string& function) const {
    const std::string name = "ending_device_" + act + "_" + function + ".so";
    std::filesystem::copy_file(hapticwall::test::plugin_folder() + "/" + name, path(name),
                               std::filesystem::copy_options::overwrite_existing);
    return "plugin:" + path(name);
  }
  // Arguments of a run on a device behind a library; the device pushes after one and a half
  // seconds.
  [[nodiscard]] std::vector<std::string> on_device(const std::string& device_option,
                                                   std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"run",         "golden-soft",         "--device",
                                   device_option, "--allow-no-realtime", "--allow-plugin",
                                   "--arm",       "--duration",          "4"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  // The commands that the device heard: "1 3.507".
  [[nodiscard]] std::vector<std::string> commands() const {
    std::vector<std::string> lines;
    std::istringstream text(size("commands") == 0 ? "" : content("commands"));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  [[nodiscard]] bool pushed() const {
    for (const std::string& line : commands()) {
      if (line.starts_with("1 ") && std::stod(line.substr(2)) >= 1.0) return true;
    }
    return false;
  }
  // A busy machine may disarm before the push: that attempt shows nothing.
  [[nodiscard]] Answer pushing_run(const std::vector<std::string>& words) const {
    Answer answer;
    for (int i = 0; i < 8 && !pushed(); ++i) {
      std::filesystem::remove(path("commands"));
      answer = hapticwall(words);
    }
    EXPECT_TRUE(pushed()) << answer.err;
    return answer;
  }
  void expect_zero_last() const {
    ASSERT_FALSE(commands().empty());
    EXPECT_EQ(commands().back(), "0 0.000");
  }
};

// ---- exit()

class EndingAlgorithm : public EndingPlugin {};

TEST_P(EndingAlgorithm, ExitIsAnErrorThatNamesIt) {
  const Answer answer = hapticwall({"run", "press", "--algorithm", algorithm("exit", GetParam()),
                                    "--json", "-", "--expect", "verdict=settled"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_EQ(answer.out, "");
  EXPECT_EQ(answer.error_lines(), 1) << answer.err;
  EXPECT_THAT(answer.err, StartsWith("error: "));
  EXPECT_THAT(answer.err, HasSubstr(std::string("its ") + GetParam()));
  EXPECT_THAT(answer.err, HasSubstr(" called exit()"));
}
INSTANTIATE_TEST_SUITE_P(Functions, EndingAlgorithm,
                         Values("constructor", "configure", "reset", "step"));

TEST_F(EndingPlugin, QuickExitIsAnErrorAndAnAbortASignal) {
  const Answer quick = hapticwall({"run", "press", "--algorithm", algorithm("quick", "step")});
  EXPECT_EQ(quick.status, 2);
  EXPECT_THAT(quick.err, HasSubstr("its step() called exit()"));
  EXPECT_EQ(hapticwall({"run", "press", "--algorithm", algorithm("abort", "step")}).status,
            128 + SIGABRT);
}

TEST_F(EndingPlugin, ExitInAMapIsAnError) {
  const Answer answer =
      hapticwall({"map", "press", "--x", "wall.stiffness_n_per_m=1e3:1e4:8", "--y",
                  "hand.mass_kg=0.3:0.4:8", "--algorithms", algorithm("exit", "step")});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("its step() called exit()"));
}

// Armed and in contact: the loop's own thread ends the process.
TEST_F(EndingPlugin, ExitOrAbortInAStepOnADeviceTakesTheForceAwayFirst) {
  for (const std::string act : {"exit", "quick", "abort"}) {
    std::filesystem::remove(path("commands"));
    const Answer answer =
        pushing_run(on_device(device("none", "none"), {"--algorithm", algorithm(act, "step")}));
    EXPECT_EQ(answer.status, act == "abort" ? 128 + SIGABRT : 2) << answer.err;
    expect_zero_last();
  }
}

class EndingDevice : public EndingPlugin {};

TEST_P(EndingDevice, ExitInContactTakesTheForceAwayFirst) {
  const Answer answer = pushing_run(on_device(device("exit", GetParam())));
  EXPECT_EQ(answer.status, 3);
  EXPECT_THAT(answer.err, HasSubstr(std::string("its ") + GetParam() + "() called exit()"));
  expect_zero_last();
}
INSTANTIATE_TEST_SUITE_P(Functions, EndingDevice, Values("read", "write", "close"));

class EndingDeviceStart : public EndingPlugin {};

TEST_P(EndingDeviceStart, ExitBeforeTheFirstCommandIsAnError) {
  const Answer answer = hapticwall(on_device(device("exit", GetParam())));
  EXPECT_EQ(answer.status, 3);
  EXPECT_THAT(answer.err, HasSubstr(std::string("its ") + GetParam() + "() called exit()"));
  EXPECT_THAT(commands(), IsEmpty());
}
INSTANTIATE_TEST_SUITE_P(Functions, EndingDeviceStart, Values("info", "open", "last_error"));

// ---- an endless call

class EndlessAlgorithm : public EndingPlugin {};

TEST_P(EndlessAlgorithm, OneSignalEndsARun) {
  const Answer answer =
      terminated({"run", "press", "--algorithm", algorithm("endless", GetParam()), "--quiet"},
                 [] { return true; });
  EXPECT_EQ(answer.status, 128 + SIGTERM);
}

// At real-time priority the kernel may end the run (SIGXCPU) before the signal does.
TEST_P(EndlessAlgorithm, OneSignalEndsARunInRealTime) {
  const Answer answer = terminated(
      {"run", "press", "--realtime", "--algorithm", algorithm("endless", GetParam()), "--quiet"},
      [] { return true; });
  EXPECT_THAT(answer.status, ::testing::AnyOf(128 + SIGTERM, 128 + SIGXCPU));
}
INSTANTIATE_TEST_SUITE_P(Functions, EndlessAlgorithm, Values("configure", "reset", "step"));

TEST_F(EndingPlugin, OneSignalEndsAMapWhoseThreadsHang) {
  const Answer answer =
      terminated({"map", "press", "--x", "wall.stiffness_n_per_m=1e3:1e4:4", "--y",
                  "hand.mass_kg=0.3:0.4:4", "--algorithms", algorithm("endless", "step")},
                 [] { return true; });
  EXPECT_EQ(answer.status, 128 + SIGTERM);
}

// The link's writer takes the force away by itself, because the newest command is too old.
TEST_F(EndingPlugin, AStepThatHangsInContactLeavesNoForce) {
  for (int i = 0; i < 8 && !pushed(); ++i) {
    std::filesystem::remove(path("commands"));
    const Answer answer = terminated(
        on_device(device("none", "none"), {"--algorithm", algorithm("endless", "step"), "--quiet"}),
        [&] { return pushed() && commands().back() == "0 0.000"; });
    if (!pushed()) continue;
    EXPECT_THAT(answer.status, ::testing::AnyOf(128 + SIGTERM, 128 + SIGXCPU)) << answer.err;
  }
  EXPECT_TRUE(pushed());
  expect_zero_last();
}

class EndlessDevice : public EndingPlugin {};

TEST_P(EndlessDevice, OneSignalEndsARun) {
  const bool opens = GetParam() == std::string("open");
  const Answer answer = terminated(on_device(device("endless", GetParam()), {"--quiet"}),
                                   [&] { return opens || pushed(); });
  EXPECT_THAT(answer.status, ::testing::AnyOf(3, 128 + SIGTERM, 128 + SIGXCPU)) << answer.err;
}
INSTANTIATE_TEST_SUITE_P(Functions, EndlessDevice, Values("open", "read", "write", "close"));

// ---- another rounding mode

class RoundingAlgorithm : public EndingPlugin {
 protected:
  // Rows of the other algorithms by name, without the speed of the machine.
  [[nodiscard]] std::map<std::string, std::string> rows(const std::string& name) const {
    const std::set<std::string> speeds{"simulated_seconds_per_second", "ns_per_tick"};
    std::map<std::string, std::string> rows;
    std::vector<std::string> header;
    std::istringstream text(content(name));
    for (std::string line; std::getline(text, line);) {
      std::vector<std::string> fields;
      std::istringstream words(line);
      for (std::string field; std::getline(words, field, ',');) fields.push_back(field);
      if (header.empty()) header = fields;
      std::string algorithm;
      std::string values;
      for (std::size_t i = 0; i < fields.size(); ++i) {
        if (header[i] == "algorithm") algorithm = fields[i];
        if (!speeds.contains(header[i])) values += fields[i] + ',';
      }
      if (!algorithm.starts_with("test-")) rows[algorithm] += values;
    }
    return rows;
  }
};

TEST_P(RoundingAlgorithm, LeavesTheRowsBesideItAsTheyAre) {
  const std::string dot = GetParam();
  const std::size_t at = dot.find('.');
  const std::string plugin = algorithm(dot.substr(0, at), dot.substr(at + 1));
  const std::string others = "energy-bounding,virtual-coupling,none";
  const Answer alone =
      hapticwall({"compare", "press", "--algorithms", others, "--csv", "alone.csv", "--quiet"});
  const Answer beside = hapticwall(
      {"compare", "press", "--algorithms", plugin + "," + others, "--csv", "beside.csv"});
  EXPECT_EQ(alone.status, 0) << alone.err;
  EXPECT_EQ(beside.status, 0) << beside.err;
  EXPECT_EQ(rows("alone.csv").size(), 4U);
  EXPECT_EQ(rows("beside.csv"), rows("alone.csv"));
  if (dot == "denormals.constructor") return;  // it changes nothing in a call
  EXPECT_THAT(beside.err, HasSubstr("changed the rounding mode or another setting"));
}
INSTANTIATE_TEST_SUITE_P(Functions, RoundingAlgorithm,
                         Values("rounding.configure", "rounding.reset", "rounding.step",
                                "denormals.step", "denormals.constructor"));

// Its workers run the cells of both.
TEST_F(RoundingAlgorithm, LeavesTheCellsBesideItAsTheyAre) {
  const auto map = [&](const std::string& algorithms, const std::string& csv) {
    return hapticwall({"map", "press", "--x", "wall.stiffness_n_per_m=1e3:1e5:6:log", "--y",
                       "hand.mass_kg=0.3:0.4:4", "--algorithms", algorithms, "--csv", csv})
        .status;
  };
  EXPECT_EQ(map("half-sample,none", "alone.csv"), 0);
  EXPECT_EQ(map(algorithm("rounding", "step") + ",half-sample,none", "beside.csv"), 0);
  EXPECT_EQ(rows("alone.csv").size(), 3U);
  EXPECT_EQ(rows("beside.csv"), rows("alone.csv"));
}

TEST_F(RoundingAlgorithm, OfADeviceIsAFailedCallAndANote) {
  for (const std::string function : {"read", "write"}) {
    const Answer answer = pushing_run(on_device(device("rounding", function)));
    EXPECT_EQ(answer.status, 3);
    EXPECT_THAT(answer.err, HasSubstr("note: the device plug-in: " + function +
                                      "() changed the rounding mode"));
    std::filesystem::remove(path("commands"));
  }
}

}  // namespace
}  // namespace hapticwall::command::test
