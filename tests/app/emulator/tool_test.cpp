// hapticwall-emulator on machines without /dev/uhid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/command/binary.h"
#include "tests/emulator/program/emulator_options.h"
#include "tests/paths.h"

namespace hapticwall::emulator {
namespace {

using command::test::Answer;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class EmulatorTool : public command::test::ProgramTest {
 protected:
  [[nodiscard]] Answer emulator(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), hapticwall::test::emulator_program());
    return wait_for(start(std::move(arguments)));
  }
  void expect_refused(std::vector<std::string> arguments, const std::string& line) {
    arguments.insert(arguments.end(), {"--log", "a.csv"});
    const Answer answer = emulator(std::move(arguments));
    EXPECT_EQ(answer.status, 2) << answer.err;
    EXPECT_EQ(answer.err, "error: " + line + "\n");
    EXPECT_THAT(answer.out, IsEmpty());
    EXPECT_THAT(files(), IsEmpty());
  }
};

TEST_F(EmulatorTool, HelpAndVersion) {
  const Answer help = emulator({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.err, IsEmpty());
  for (const char* word : {"[SCENE]", "--fault", "--in-step", "unplugged@10+2", "encoder-fault",
                           "Exit status: 0 success"}) {
    EXPECT_THAT(help.out, HasSubstr(word));
  }
  const Answer version = emulator({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, StartsWith("hapticwall-emulator "));
}

TEST_F(EmulatorTool, MistakesAreOneLineEachAndLeaveNothing) {
  expect_refused(
      {"nope"},
      "'nope' is neither a file nor a built-in scene; built in: bump, corner, detents, layers, "
      "light, mass, press, tap, tap-slow, tissue, golden-hard, golden-soft, golden-soft-fric");
  expect_refused({"--set", "device.mass=3"},
                 "--set device.mass=3: device.mass: unknown key; did you mean 'mass_kg'?");
  expect_refused({"--vendor", "12345"},
                 "--vendor '12345': it takes a hexadecimal number, 0 to ffff");
  expect_refused({"--product", "0x"}, "--product '0x': it takes a hexadecimal number, 0 to ffff");
  expect_refused({"--serial", ""}, "--serial '': it takes 1 to 63 bytes");
  expect_refused({"--watchdog", "101"}, "--watchdog '101': it takes whole milliseconds, 1 to 100");
  expect_refused({"--duration", "0"},
                 "--duration '0': it takes seconds, more than 0 and at most 86400");
  expect_refused({"--hand", "waves"}, "--hand 'waves': it takes 'waits' or 'goes'");
  expect_refused({"--set", "sampling.rate_hz=3000"},
                 "press: sampling.rate_hz: 3000 Hz; the tick of a device is a whole number of "
                 "microseconds, 1 to 19999");
  expect_refused({"--set", "hand.path=\"mouse\""},
                 "press: hand.path: the emulator has no mouse to follow; --set 'hand.path=[[0, "
                 "0.03], [1, 0.06]]' gives it a path");
  expect_refused(
      {"--set", "sampling.rate_hz=500", "--y", "press"},
      "--y 'press': its sampling.rate_hz differs from that of the first scene; both axes "
      "share one tick");
  expect_refused({"--fault", "frozen"},
                 "--fault 'frozen': it takes KIND@BEGIN+DURATION in seconds, e.g. unplugged@3+1");
}

TEST_F(EmulatorTool, ALogThatCannotBeWrittenIsToldBeforeAnythingRuns) {
  const Answer answer = emulator({"--log", "no/such/folder/a.csv"});
  EXPECT_EQ(answer.status, 4);
  EXPECT_EQ(answer.error_lines(), 1);
  EXPECT_THAT(answer.err, StartsWith("error: no/such/folder/a.csv"));
}

TEST_F(EmulatorTool, WithoutUhidItSaysWhatToDo) {
  if (std::filesystem::exists("/dev/uhid")) {
    GTEST_SKIP() << "this machine has /dev/uhid; tests/hid_guest tries what follows";
  }
  const Answer answer = emulator({"press", "--log", "a.csv"});
  EXPECT_EQ(answer.status, 3);
  EXPECT_EQ(answer.err,
            "error: /dev/uhid: No such file or directory; the kernel module uhid is not loaded: "
            "run 'modprobe uhid' as root\n");
  EXPECT_THAT(files(), IsEmpty());
}

TEST(EmulatorPlan, TakesEveryOption) {
  EmulatorOptions options;
  options.scenes[0] = "tap";
  options.scenes[1] = "press";
  options.settings = {"hand.mass_kg=0.3"};
  options.vendor = "0xABCD";
  options.product = "12";
  options.serial = "left";
  options.name = "A device";
  options.hand = "goes";
  options.watchdog_ms = "30";
  options.duration = "1.5";
  options.faults = {"silent@1+0.1", "short@0+9/3"};
  options.in_step = true;
  options.without_info = true;
  const Result<Plan> plan = make_plan(options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->device.axes[0].name, "tap");
  EXPECT_EQ(plan->device.axes[0].x().hand->mass_kg, 0.3);
  ASSERT_EQ(plan->device.axes.size(), 2U);
  EXPECT_EQ(plan->device.axes[1].name, "press");
  EXPECT_EQ(plan->device.watchdog_ms, 30);
  EXPECT_FALSE(plan->device.has_info);
  EXPECT_FALSE(plan->device.hand_waits);
  EXPECT_EQ(plan->identity.vendor_id, 0xABCD);
  EXPECT_EQ(plan->identity.product_id, 0x12);
  EXPECT_EQ(plan->identity.serial, "left");
  EXPECT_EQ(plan->identity.name, "A device");
  EXPECT_EQ(plan->loop.duration_us, 1'500'000U);
  EXPECT_TRUE(plan->loop.in_step);
  EXPECT_TRUE(plan->faults.lasts(device::hid::FaultKind::kSilent, 1'050'000));
  EXPECT_TRUE(plan->faults.strikes(device::hid::FaultKind::kShort, 3000, 1000));
  EXPECT_FALSE(plan->faults.strikes(device::hid::FaultKind::kShort, 4000, 1000));
}

TEST(EmulatorPlan, WithoutOptionsIsThePaperDeviceWithItsHandWaiting) {
  const Result<Plan> plan = make_plan({});
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->device.axes[0].name, "press");
  EXPECT_TRUE(plan->device.hand_waits);
  EXPECT_TRUE(plan->device.has_info);
  EXPECT_EQ(plan->identity.vendor_id, device::hid::kTestVendorId);
  EXPECT_EQ(plan->identity.product_id, device::hid::kTestProductId);
  EXPECT_EQ(plan->loop.duration_us, 0U);
}

}  // namespace
}  // namespace hapticwall::emulator
