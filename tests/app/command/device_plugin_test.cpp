// Devices from shared libraries, by the whole program and in real time: the example in C, and one
// with a fault.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

// The hand of the example comes 45 mm forward.
constexpr const char* kSoftWall = R"(
name = "soft"
duration_s = 2.6
[device]
mass_kg = 0.1
damping_n_s_per_m = 1.0
start_m = 0.03
[[wall]]
position_m = 0.05
stiffness_n_per_m = 400.0
damping_n_s_per_m = 0.0
[algorithm]
name = "none"
)";

std::string device_library(const std::string& name) {
  return "plugin:" + hapticwall::test::plugin_folder() + "/" + name + ".so";
}

class DevicePluginTest : public ProgramTest {
 protected:
  Answer run(const std::string& library, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"run",
                                   "golden-soft",
                                   "--device",
                                   device_library(library),
                                   "--allow-no-realtime",
                                   "--allow-plugin",
                                   "--duration",
                                   "4",
                                   "--csv",
                                   "a.csv"};
    words.insert(words.end(), more.begin(), more.end());
    return hapticwall(words);
  }
};

TEST_F(DevicePluginTest, TheExampleIsMeasuredWithoutForce) {
  const Answer answer = hapticwall(
      {"timing", "--device", device_library("handle_c"), "--seconds", "0.5", "--json", "-"});
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("Simulated handle in C ["));
}

TEST_F(DevicePluginTest, NeedsPermissionToPush) {
  const Answer answer =
      hapticwall({"run", "press", "--device", device_library("handle_c"), "--arm"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("drives a device only with --allow-plugin"));
  EXPECT_EQ(answer.error_lines(), 1);
}

TEST_F(DevicePluginTest, IsNotReplacedByAnOutput) {
  std::filesystem::copy(device_library("handle_c").substr(std::string("plugin:").size()),
                        path("mine.so"));
  const std::string before = content("mine.so");
  for (const std::string command : {"run tap --allow-plugin", "timing", "identify"}) {
    const Answer answer =
        shell("$P " + command + " --device plugin:./mine.so --json mine.so --quiet");
    EXPECT_EQ(answer.status, 2) << command;
    EXPECT_EQ(answer.err,
              "error: --json 'mine.so': it would replace an input file; choose another name\n");
    EXPECT_TRUE(content("mine.so") == before);
  }
}

// The run is in real time, on a machine that may be busy: a delayed attempt does not count.
TEST_F(DevicePluginTest, TheExamplePressesIntoAWallAndIsRecorded) {
  put("soft.toml", kSoftWall);
  Answer answer;
  for (int i = 0; i < 12 && answer.status != 0; ++i) {
    answer = hapticwall({"run", "soft.toml", "--device", device_library("handle_c"), "--arm",
                         "--allow-plugin", "--allow-no-realtime", "--csv", "a.csv", "--expect",
                         "peak_force_n>2", "--expect", "peak_force_n<=8", "--quiet"});
  }
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(content("a.toml"), HasSubstr("Simulated handle in C ["));
}

struct Refusal {
  const char* library;
  int status;
  const char* words;

  friend std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
    return out << refusal.library;
  }
};
class DevicePluginRefusal : public DevicePluginTest,
                            public ::testing::WithParamInterface<Refusal> {};

TEST_P(DevicePluginRefusal, IsOneSentence) {
  const Answer answer = run(GetParam().library);
  EXPECT_EQ(answer.status, GetParam().status);
  EXPECT_THAT(answer.err, HasSubstr(GetParam().words));
  EXPECT_EQ(answer.error_lines(), 1) << answer.err;
}
INSTANTIATE_TEST_SUITE_P(
    Libraries, DevicePluginRefusal,
    ::testing::Values(
        Refusal{"device_abi", 2, "it was built for ABI 9, this program has ABI 1"},
        Refusal{"device_null", 2, "info, open, read, write, close or last_error is NULL"},
        Refusal{"plugin_sound", 2, "it exports no hapticwall_device"},
        Refusal{"no_such", 2, "cannot be read"},
        Refusal{
            "device_wrong_info", 3,
            "info(): force_limit_n: 50 is out of range; it takes more than 0, at most 32.767 N"},
        Refusal{"device_fails_to_open", 3, "open() failed: no handle?is ?[1mconnected"}),
    [](const auto& refusal) { return std::string(refusal.param.library); });

}  // namespace
}  // namespace hapticwall::command::test
