// What users get wrong: one clear line, the right exit status, nothing left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "app/file/scene_file.h"
#include "tests/app/command_binary.h"

namespace hapticwall::command::test {
namespace {

using ::testing::IsEmpty;
using ::testing::StartsWith;

class BadInput : public ProgramTest {
 protected:
  // Runs with every kind of output asked for: none may come to be.
  void expect_refused(std::vector<std::string> arguments, int status, const std::string& line) {
    const std::vector<std::string> before = files();
    const Answer answer = hapticwall(std::move(arguments));
    EXPECT_EQ(answer.status, status) << answer.err;
    EXPECT_EQ(answer.err, "error: " + line + "\n");
    EXPECT_THAT(answer.out, IsEmpty());
    EXPECT_EQ(files(), before);
  }

  void expect_scene_refused(const std::string& from, const std::string& to,
                            const std::string& line) {
    put("bad.toml", press_with(from, to));
    expect_refused({"run", "bad.toml", "--csv", "a.csv", "--json", "a.json"}, 2, line);
  }

  static std::string press_with(const std::string& from, const std::string& to) {
    for (const file::BuiltinScene& scene : file::builtin_scenes()) {
      if (scene.name != "press") continue;
      std::string text(scene.toml_text);
      return text.replace(text.find(from), from.size(), to);
    }
    return {};
  }
};

TEST_F(BadInput, SceneMistakes) {
  expect_scene_refused("friction_n", "fricton_n",
                       "bad.toml:15: device.fricton_n: unknown key; did you mean 'friction_n'?");
  expect_scene_refused("mass_kg = 0.05", "mass_kg = true",
                       "bad.toml:13: device.mass_kg: true where a number in kg belongs");
  expect_scene_refused("mass_kg = 0.05", "mass_kg = nan",
                       "bad.toml:13: device.mass_kg: nan is not a finite number");
  expect_scene_refused(
      "mass_kg = 0.05", "mass_kg = -0.05",
      "bad.toml:13: device.mass_kg: -0.05 is out of range; it takes 1e-6 to 1000 kg");
  expect_scene_refused("mass_kg = 0.4\n", "",
                       "bad.toml:23: hand.grip_stiffness_n_per_m: a grip holds the handle with a "
                       "hand's mass: hand.mass_kg is missing");
}

TEST_F(BadInput, ScenesThatAreNone) {
  expect_refused({"run", "missing.toml"}, 2,
                 "missing.toml: cannot be read: No such file or directory");
  expect_refused({"run", "."}, 2, ".: cannot be read: Is a directory");
  expect_refused(
      {"run", "pres"}, 2,
      "'pres' is neither a file nor a built-in scene; did you mean 'press'?; built in: "
      "corner, layers, light, press, tap, tap-slow, golden-hard, golden-soft, golden-soft-fric");
  expect_refused({"pres"}, 2,
                 "'pres' is neither a command, a built-in scene nor a file; did you mean 'press'?");
  expect_refused({"rnu", "press"}, 2,
                 "'rnu' is neither a command, a built-in scene nor a file; did you mean 'run'?");
  put("empty.toml", "");
  expect_refused({"run", "empty.toml"}, 2, "empty.toml: not a scene: empty");
  put("nul.toml", std::string(100, '\0'));
  EXPECT_EQ(hapticwall({"run", "nul.toml"}).status, 2);
}

TEST_F(BadInput, TenMegabytesOfGarbage) {
  constexpr std::size_t kGarbageBytes = 10'000'000;
  std::string garbage;
  garbage.resize(kGarbageBytes);
  std::mt19937 random(1);
  for (char& c : garbage) c = static_cast<char>(random() & 0xffU);
  put("garbage.toml", garbage);
  expect_refused({"run", "garbage.toml", "--csv", "a.csv"}, 2,
                 "garbage.toml: not a scene: larger than 1048576 bytes");
  put("garbage.toml", garbage.substr(0, 1'000'000));
  const Answer answer = hapticwall({"run", "garbage.toml", "--csv", "a.csv"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, StartsWith("error: garbage.toml:1: not valid TOML: "));
  EXPECT_EQ(answer.error_lines(), 1);
}

TEST_F(BadInput, Settings) {
  expect_refused({"run", "press", "--set", "nonsense"}, 2,
                 "--set nonsense: there is no '=': it takes KEY=VALUE");
  expect_refused({"run", "press", "--set", "hand.stifness=3"}, 2,
                 "--set hand.stifness=3: hand.stifness: unknown key; did you mean "
                 "'stiffness_n_per_m'?");
  expect_refused({"compare", "press", "--set", "wall.stiffness_n_per_m=\x1b[31m"}, 2,
                 "--set wall.stiffness_n_per_m=?[31m: the value is not one line of TOML");
  expect_refused({"run", "press", "--set", "hand.path=mouse"}, 2,
                 "press: hand.path: the hand follows the mouse, which only the window has; --set "
                 "'hand.path=[[0, 0.03], [1, 0.06]]' gives it a path");
  expect_refused(
      {"run", "press", "--algorithm", "energy-bonding"}, 2,
      "--algorithm 'energy-bonding': no algorithm is called so; did you mean "
      "'energy-bounding'?; known: none, virtual-coupling, passivity-control, "
      "energy-bounding, energy-bounding-2010, force-bounding, half-sample, energy-bookkeeping");
  expect_refused(
      {"compare", "press", "--algorithms", "none,nine"}, 2,
      "--algorithms 'nine': no algorithm is called so; did you mean 'none'?; known: none, "
      "virtual-coupling, passivity-control, energy-bounding, energy-bounding-2010, force-bounding, "
      "half-sample, energy-bookkeeping");
}

TEST_F(BadInput, Options) {
  for (const std::string duration : {"-1", "0", "abc", "nan", "1e99", "1s"}) {
    expect_refused({"run", "press", "--duration", duration}, 2,
                   "--duration '" + duration + "': it takes seconds, more than 0 and at most 1e6");
  }
  expect_refused({"run", "press", "--seed", "-1"}, 2,
                 "--seed: '-1' is not a whole number from 0 on");
  expect_refused({"run", "press", "--bogus"}, 2,
                 "The following argument was not expected: --bogus");
  expect_refused({"run"}, 2, "SCENE is required");
  for (const std::string device : {"ie3000", "ie2000:", "", "simulator"}) {
    expect_refused({"run", "press", "--device", device}, 3,
                   "--device '" + device +
                       "': it takes sim, ie2000 or ie2000:PATH; 'hapticwall devices' lists what "
                       "is connected");
  }
  expect_refused({"compare", "press", "--device", "ie2000"}, 3,
                 "--device 'ie2000': 'compare' computes on the simulator only, 'sim'; 'hapticwall "
                 "run' and the window drive a device");
  expect_refused({"run", "press", "--arm"}, 2,
                 "--arm: the simulator needs no arming; it is for --device ie2000");
  expect_refused({"run", "press", "--plot", "a.png", "--duration", "1001"}, 2,
                 "--plot: a figure shows at most 1000000 ticks, this run has 1001000; --duration "
                 "shortens it");
  EXPECT_THAT(hapticwall({"run", "press", "--expect", "settled"}).err,
              StartsWith("error: --expect 'settled': "));
}

TEST_F(BadInput, OutputsThatCannotBe) {
  expect_refused({"run", "press", "--csv", "no/a.csv"}, 4,
                 "no/a.csv: cannot be written: No such file or directory");
  expect_refused({"run", "press", "--csv", "."}, 4,
                 ".: cannot be written: it exists and is not a regular file");
  expect_refused({"run", "press", "--json", "no/a.json", "--csv", "a.csv"}, 4,
                 "no/a.json: cannot be written: No such file or directory");
  expect_refused({"run", "press", "--csv", "a.csv", "--plot", "no/a.png"}, 4,
                 "no/a.png: cannot be written: No such file or directory");
  expect_refused({"compare", "press", "--csv", "no/a.csv"}, 4,
                 "no/a.csv: cannot be written: No such file or directory");
  expect_refused({"run", "press", "--csv", "-"}, 2, "--csv -: it takes the name of a file");
  expect_refused({"run", "press", "--csv", "a", "--json", "a"}, 2,
                 "--csv and --json are the same file, 'a'");
  expect_refused({"run", "press", "--csv", "a.csv", "--json", "a.toml"}, 2,
                 "--json and the sidecar of --csv are the same file, 'a.toml'");
}

TEST_F(BadInput, AUsersSceneIsNotOverwritten) {
  const std::string scene = press_with("\"press\"", "\"mine\"");
  put("mine.toml", scene);
  expect_refused({"run", "mine.toml", "--csv", "mine.csv"}, 4,
                 "mine.csv: cannot be recorded: its sidecar mine.toml would replace a file that is "
                 "not a recording's; choose another name");
  EXPECT_EQ(content("mine.toml"), scene);
}

TEST_F(BadInput, MessagesAreShortAndClean) {
  const std::string word = "x\n\x1b[31m\xff" + std::string(100'000, 'y');
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{word},
                                                    {"run", word},
                                                    {"run", "press", "--set", word},
                                                    {"run", "press", "--set", word + "=1"},
                                                    {"run", "press", "--algorithm", word},
                                                    {"run", "press", "--" + word},
                                                    {"run", "press", "--expect", word + "=1"},
                                                    {"run", "press", "--csv", word + "/a"},
                                                    {"run", "press", "--device", word}}) {
    const Answer answer = hapticwall(arguments);
    EXPECT_GE(answer.status, 2);
    EXPECT_LE(answer.status, 4);
    EXPECT_EQ(answer.error_lines(), 1) << answer.err;
    EXPECT_LT(answer.err.size(), 1200U);
    EXPECT_EQ(answer.err.find('\x1b'), std::string::npos);
  }
}

}  // namespace
}  // namespace hapticwall::command::test
