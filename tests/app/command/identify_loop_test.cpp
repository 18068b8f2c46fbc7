// The experiment of `identify` in the loop of a session, through the whole link and the emulated
// firmware, in virtual time: an honest device, and devices that lie.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/session/identify_experiment.h"
#include "core/study/identify/identify.h"
#include "tests/app/session/loop/lie_rig.h"
#include "tests/emulator/program/emulator_options.h"

namespace hapticwall::command {
namespace {

using identify::ExperimentState;
using session::ArmingState;
using session::IdentifyExperiment;
using session::IdentifyStage;
using session::test::LieRig;

constexpr double kEncoderM = 30e-6;
constexpr double kMassKg = 0.08;
constexpr double kDampingNSPerM = 1.2;
constexpr double kFrictionN = 0.1;
constexpr double kLimitN = 1.5;
constexpr std::uint64_t kLieMs = 6000;

device::hid::EmulatorSettings free_device() {
  device::hid::EmulatorSettings settings = device::hid::testing::one_axis();
  AxisSettings& axis = settings.axes[0].x();
  axis.hand.reset();
  axis.device.mass_kg = kMassKg;
  axis.device.damping_n_s_per_m = kDampingNSPerM;
  axis.device.friction_n = kFrictionN;
  axis.device.encoder_m = kEncoderM;
  return settings;
}

Scene free_scene() {
  Scene scene;
  scene.x().device.force_limit_n = kLimitN;
  scene.algorithm.index = *find_algorithm("none");
  return scene;
}

identify::ExperimentSettings experiment_for_it() {
  identify::ExperimentSettings settings;
  settings.force_limit_n = kLimitN;
  settings.encoder_m = kEncoderM;
  settings.duration_s = 12.0;
  return settings;
}

// Looks at the experiment in every tick, as the owner of a session does.
class IdentifyRig {
 public:
  explicit IdentifyRig(const std::string& lie = "")
      : experiment(experiment_for_it()),
        rig(script(lie), free_device(), {}, free_scene(), &experiment.algorithm()) {
    rig.on_tick = [this] {
      experiment.add(rig.snapshot().newest);
      over = experiment.look(rig.snapshot());
    };
    rig.until_ms(50);
    rig.arm();
    while (!experiment.algorithm().begun()) {
      rig.tick();
      EXPECT_EQ(rig.last_force_us, 0U) << "no force before the whole gain";
    }
    EXPECT_EQ(rig.arming().state, ArmingState::kOn);
  }
  void until_over() {
    for (int i = 0; i < 30'000 && !over; ++i) rig.tick();
    EXPECT_TRUE(over);
  }

  IdentifyExperiment experiment;
  bool over = false;
  LieRig rig;

 private:
  static device::hid::FaultScript script(const std::string& lie) {
    if (lie.empty()) return {};
    const auto fault = emulator::parse_fault(lie);
    EXPECT_TRUE(fault.ok()) << lie;
    return fault ? device::hid::FaultScript{*fault} : device::hid::FaultScript{};
  }
};

TEST(IdentifyLoop, FindsTheNumbersOfTheEmulatedDevice) {
  IdentifyRig rig;
  rig.until_over();
  ASSERT_EQ(rig.experiment.facts().state, ExperimentState::kDone);
  EXPECT_LE(rig.rig.peak_n, kLimitN);
  EXPECT_FALSE(rig.experiment.trouble());
  const identify::Record record = rig.experiment.record();
  EXPECT_EQ(record.position_m.size(), rig.experiment.facts().ticks);
  const auto found = identify::identify(record, rig.experiment.facts());
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->fits) << found->residual_ratio;
  EXPECT_NEAR(found->mass_kg.value, kMassKg, 0.01 * kMassKg);
  EXPECT_NEAR(found->damping_n_s_per_m.value, kDampingNSPerM, 0.02 * kDampingNSPerM);
  EXPECT_NEAR(found->friction_n.value, kFrictionN, 2e-3);
  EXPECT_GT(found->delay_s.value, 0.2e-3) << "the link takes time";
  EXPECT_LT(found->delay_s.value, 3e-3);
}

// The kinds are those of device_lies_test.cpp that show without a wall.
TEST(IdentifyLoop, ALieEndsTheForce) {
  for (const char* kind :
       {"jump=0.05", "jump=-0.012", "runaway=12", "runaway=0.5", "slow", "no-answer", "no-output",
        "not-enabled", "no-force", "rejects", "other-force", "other-force=-1", "foreign-force"}) {
    SCOPED_TRACE(kind);
    IdentifyRig rig(std::string(kind) + "@" + std::to_string(1e-3 * kLieMs) + "+3");
    rig.rig.until_ms(kLieMs - 1);
    EXPECT_FALSE(rig.over);
    EXPECT_GT(rig.rig.last_force_us, 1000 * (kLieMs - 500)) << "it pushes before the lie";
    rig.until_over();
    const std::uint64_t end_us = rig.rig.now_us();
    EXPECT_LT(end_us, 1000 * (kLieMs + 1000));
    rig.rig.until_ms(end_us / 1000 + 4000);
    EXPECT_LT(rig.rig.last_force_us, end_us + 22'000) << "and the force stays off";
    EXPECT_LE(rig.rig.peak_n, kLimitN + 1e-9);
    const Failure told = rig.experiment.trouble();
    ASSERT_TRUE(told);
    EXPECT_TRUE(told->message.starts_with("the experiment ended with the force off: "));
    EXPECT_FALSE(told->message.ends_with(": "));
  }
}

void expect_no_force_after(IdentifyRig& rig, std::uint64_t end_us) {
  rig.rig.until_ms(end_us / 1000 + 3000);
  EXPECT_LE(rig.rig.last_force_us, end_us + 1000);
}

TEST(IdentifyLoop, DisarmingEndsTheForceInTheNextTick) {
  IdentifyRig rig;
  rig.rig.until_ms(kLieMs);
  ASSERT_GT(rig.rig.last_force_us, 1000 * (kLieMs - 500));
  rig.rig.disarm();
  rig.rig.tick();
  EXPECT_TRUE(rig.over);
  EXPECT_EQ(rig.experiment.trouble()->message,
            "the experiment ended with the force off: switched off");
  expect_no_force_after(rig, rig.rig.now_us());
}

// Stopping does not wait until the device is disarmed.
TEST(IdentifyLoop, StoppingEndsTheForceInTheNextTick) {
  IdentifyRig rig;
  rig.rig.until_ms(kLieMs);
  rig.experiment.stop("a reason");
  rig.rig.tick();
  EXPECT_TRUE(rig.over);
  EXPECT_EQ(rig.rig.arming().state, ArmingState::kOn);
  EXPECT_EQ(rig.experiment.trouble()->message, "the experiment ended with the force off: a reason");
  expect_no_force_after(rig, rig.rig.now_us());
}

// An owner that looks too late.
TEST(IdentifyLoop, ArmingAgainDoesNotBringTheForceBack) {
  IdentifyRig rig;
  rig.rig.until_ms(kLieMs);
  rig.rig.on_tick = {};
  rig.rig.disarm();
  rig.rig.until_ms(kLieMs + 100);
  const std::uint64_t off_us = rig.rig.now_us();
  rig.rig.arm();
  expect_no_force_after(rig, off_us);
  EXPECT_EQ(rig.rig.arming().state, ArmingState::kOn);
  EXPECT_TRUE(rig.experiment.look(rig.rig.snapshot()));
  EXPECT_EQ(rig.experiment.trouble()->message,
            "the experiment ended with the force off: the force was taken away");
}

TEST(IdentifyLoop, MissingTicksEndIt) {
  IdentifyRig rig;
  rig.rig.until_ms(kLieMs);
  rig.rig.on_tick = {};
  rig.rig.tick();
  rig.experiment.add(rig.rig.snapshot().newest);
  EXPECT_FALSE(rig.experiment.look(rig.rig.snapshot()));
  rig.rig.tick();
  rig.rig.tick();
  rig.experiment.add(rig.rig.snapshot().newest);
  EXPECT_TRUE(rig.experiment.look(rig.rig.snapshot()));
  expect_no_force_after(rig, rig.rig.now_us());
}

TEST(IdentifyLoop, ShowsItsProgress) {
  IdentifyRig rig;
  EXPECT_EQ(rig.experiment.progress().stage, IdentifyStage::kWaits);
  rig.rig.tick();
  EXPECT_EQ(rig.experiment.progress().stage, IdentifyStage::kRest);
  rig.rig.until_ms(rig.rig.now_us() / 1000 + 600);
  EXPECT_EQ(rig.experiment.progress().stage, IdentifyStage::kRamps);
  rig.rig.until_ms(kLieMs);
  const session::IdentifyProgress shown = rig.experiment.progress();
  EXPECT_EQ(shown.stage, IdentifyStage::kStrokes);
  EXPECT_GT(shown.strokes_s, 1.0);
  EXPECT_LT(shown.strokes_s, 1e-3 * static_cast<double>(kLieMs));
  EXPECT_LT(shown.lowest_m, -5e-3);
  EXPECT_GT(shown.highest_m, 5e-3);
  rig.until_over();
  EXPECT_EQ(rig.experiment.progress().stage, IdentifyStage::kOver);
}

}  // namespace
}  // namespace hapticwall::command
