// A session without a window, on a device that a test leads.
#include "app/command/run/realtime_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "app/command/report/expectation.h"
#include "app/command/report/summary_fields.h"
#include "tests/app/session/support.h"

namespace hapticwall::command {
namespace {

using session::test::FakeDevice;
using ::testing::HasSubstr;

constexpr double kOutsideM = 0.049;
constexpr double kInsideM = 0.0502;
constexpr double kEndlessS = 1000.0;  // the device ends the run

Scene wall_for(double duration_s) {
  Scene scene;
  scene.name = "wall";
  scene.duration_s = duration_s;
  scene.x().walls = {{.position_m = 0.05, .stiffness_n_per_m = 1e4}};
  scene.algorithm.index = find_algorithm("none").value();
  return scene;
}

// Answers as a good device does, until the test's lead says otherwise.
class LedDevice : public FakeDevice {
 public:
  explicit LedDevice(std::function<void(LedDevice&)> lead) : lead_(std::move(lead)) {
    position_m = kOutsideM;
    force_limit_n = 1.0;
    figures.connected = true;
    figures.force_word = device::ForceWord::kSame;
    figures.missing_states = 2;
    figures.void_reports = 3;
    figures.applied_commands = 40;
    figures.lost_commands = 5;
  }
  [[nodiscard]] DeviceReading read() override {
    lead_(*this);
    ++ticks;
    return FakeDevice::read();
  }
  int ticks = 0;

 private:
  std::function<void(LedDevice&)> lead_;
};

RealtimeOutcome run_on(const std::function<void(LedDevice&)>& lead, double duration_s = 0.15) {
  const Scene scene = wall_for(duration_s);
  RealtimeRun run{.scene = scene,
                  .device = std::make_unique<LedDevice>(lead),
                  .arm = true,
                  .allow_no_realtime = true};
  Result<RealtimeOutcome> outcome = run_realtime(std::move(run));
  EXPECT_TRUE(outcome) << outcome.error().message;
  return outcome ? *outcome : RealtimeOutcome{};
}

std::string told(const RealtimeOutcome& outcome) {
  return outcome.trouble ? outcome.trouble->message : "";
}

nlohmann::json json_of(const RealtimeOutcome& outcome) {
  return nlohmann::json::parse(summary_json(outcome.summary));
}

TEST(RealtimeRun, TellsWhatTheLinkDid) {
  const RealtimeOutcome outcome = run_on([](LedDevice& device) { device.figures.delay_s = 2e-3; });
  EXPECT_EQ(told(outcome), "");
  const nlohmann::json json = json_of(outcome);
  EXPECT_EQ(json["missing_states"], 2);
  EXPECT_EQ(json["void_reports"], 3);
  EXPECT_EQ(json["applied_commands"], 40);
  EXPECT_EQ(json["lost_commands"], 5);
  EXPECT_EQ(json["rejected_commands"], 0);
  EXPECT_EQ(json["delay_s"], 2e-3);
  EXPECT_TRUE(json["missed_ticks"].is_number_unsigned());
  EXPECT_TRUE(json["disarmed_at_s"].is_null());
  EXPECT_TRUE(json["disarm_reason"].is_null());
  EXPECT_THAT(outcome.status, HasSubstr("delay 2000 us"));
}

TEST(RealtimeRun, AnUnknownDelayIsNotZero) {
  const RealtimeOutcome outcome = run_on([](LedDevice&) {});
  EXPECT_TRUE(json_of(outcome)["delay_s"].is_null());
  EXPECT_THAT(outcome.status, HasSubstr("delay unknown"));
}

// The device ends the run once it is enabled.
TEST(RealtimeRun, ArmsWhenTheHandleHasLeftTheWall) {
  const RealtimeOutcome outcome = run_on(
      [&](LedDevice& device) {
        device.position_m = device.ticks < 100 ? kInsideM : kOutsideM;
        EXPECT_FALSE(device.enabled && device.ticks < 100) << device.ticks;
        if (device.enabled) device.figures.rejected_commands = 1;
      },
      kEndlessS);
  EXPECT_THAT(told(outcome), HasSubstr("the device rejects commands"));
}

TEST(RealtimeRun, AHandleThatStaysInTheWallIsToldAtTheEnd) {
  const RealtimeOutcome outcome = run_on([](LedDevice& device) {
    device.position_m = kInsideM;
    EXPECT_FALSE(device.enabled);
  });
  EXPECT_THAT(told(outcome), HasSubstr("the force stayed off: the handle was inside the wall"));
  EXPECT_FALSE(outcome.stopped_early);
}

// The summary has what was before it; no verdict, because its last second is missing.
TEST(RealtimeRun, ADisarmingHasItsReasonAndItsTime) {
  const RealtimeOutcome outcome = run_on(
      [](LedDevice& device) {
        if (device.enabled) device.figures.rejected_commands = 1;
      },
      kEndlessS);
  EXPECT_THAT(told(outcome), HasSubstr("fake: the device rejects commands; the force is off"));
  EXPECT_EQ(outcome.trouble->kind, ErrorKind::kDevice);
  const nlohmann::json json = json_of(outcome);
  EXPECT_EQ(json["disarm_reason"], "the device rejects commands");
  EXPECT_GT(json["disarmed_at_s"], 0.0);
  EXPECT_LT(json["disarmed_at_s"], json["duration_s"]);
  EXPECT_TRUE(json["verdict"].is_null());
  for (const char* holds : {"rejected_commands=1", "disarm_reason=the device rejects commands",
                            "disarmed_at_s<500", "void_reports=3", "lost_commands>4"}) {
    EXPECT_EQ(unmet(*parse_expectation(holds), outcome.summary), std::nullopt) << holds;
  }
  for (const char* fails : {"disarm_reason=no", "delay_s<1", "verdict=settled"}) {
    EXPECT_NE(unmet(*parse_expectation(fails), outcome.summary), std::nullopt) << fails;
  }
}

TEST(RealtimeRun, ALossIsADisarmingToo) {
  const RealtimeOutcome outcome = run_on(
      [](LedDevice& device) {
        if (!device.enabled) return;
        device.state = DeviceState::kFault;
        device.figures.trouble = device::Trouble::kEmergencyStop;
      },
      kEndlessS);
  EXPECT_THAT(told(outcome), HasSubstr("the emergency stop of the device is pressed"));
  EXPECT_EQ(json_of(outcome)["disarm_reason"], "the emergency stop of the device is pressed");
}

TEST(RealtimeRun, ASessionAtItsLimitSaysSo) {
  const RealtimeOutcome outcome = run_on(
      [](LedDevice& device) { device.position_m = device.enabled ? kInsideM : kOutsideM; }, 2.5);
  EXPECT_FALSE(outcome.trouble);
  EXPECT_FALSE(outcome.stopped_early);
  EXPECT_EQ(json_of(outcome)["verdict_note"], session::kAtLimitText);
  EXPECT_TRUE(json_of(outcome)["disarm_reason"].is_null());
}

TEST(RealtimeRun, AForceThatIsToldWhileDisarmedEndsTheRun) {
  const RealtimeOutcome outcome = run_on(
      [](LedDevice& device) {
        device.figures.force_word = device::ForceWord::kUnasked;
        device.figures.same_words = 10;
      },
      kEndlessS);
  EXPECT_THAT(told(outcome), HasSubstr("gives a force while it is disarmed"));
  EXPECT_EQ(json_of(outcome)["disarm_reason"],
            "the device says that it gives a force while it is disarmed");
}

TEST(RealtimeRun, ASlowDeviceIsRefusedAndNamesItsOption) {
  const RealtimeOutcome outcome =
      run_on([](LedDevice& device) { device.figures.delay_s = 6e-3; }, kEndlessS);
  EXPECT_THAT(told(outcome), HasSubstr("--allow-slow-device"));
}

TEST(RealtimeRun, TheSimulatorHasNoLink) {
  const Scene scene = wall_for(0.05);
  const Result<RealtimeOutcome> outcome = run_realtime({.scene = scene, .allow_no_realtime = true});
  ASSERT_TRUE(outcome);
  const nlohmann::json json = json_of(*outcome);
  EXPECT_TRUE(json["missed_ticks"].is_number_unsigned());
  EXPECT_TRUE(json["void_reports"].is_null());
  EXPECT_TRUE(json["delay_s"].is_null());
}

}  // namespace
}  // namespace hapticwall::command
