// The experiment of `identify` in the loop of a session, through the whole link and the emulated
// firmware, in virtual time: an honest device, and devices that lie.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/command/identify/experiment_law.h"
#include "app/emulator/emulator_options.h"
#include "core/identify/identify.h"
#include "tests/app/runtime/loop/lie_rig.h"

namespace hapticwall::command {
namespace {

using identify::ExperimentState;
using runtime::ArmingState;
using runtime::test::LieRig;

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

identify::ExperimentSettings experiment() {
  identify::ExperimentSettings settings;
  settings.force_limit_n = kLimitN;
  settings.encoder_m = kEncoderM;
  settings.duration_s = 12.0;
  return settings;
}

class IdentifyRig {
 public:
  explicit IdentifyRig(const std::string& lie = "")
      : law(experiment()), rig(script(lie), free_device(), {}, free_scene(), &law) {
    rig.on_tick = [this] {
      const Sample& sample = newest = rig.snapshot().newest.x();
      if (law.facts().ticks <= record.position_m.size()) return;
      record.position_m.push_back(sample.position_m);
      record.force_n.push_back(sample.force_n);
    };
    record.encoder_m = kEncoderM;
    rig.until_ms(50);
    rig.arm();
    while (rig.arming().state != ArmingState::kOn) {
      rig.tick();
      EXPECT_EQ(rig.last_force_us, 0U) << "no force before the whole gain";
    }
    law.begin();
  }
  void until_over() {
    for (int i = 0; i < 30'000 && !over(); ++i) rig.tick();
    EXPECT_TRUE(over());
  }
  [[nodiscard]] bool over() { return law.ended() || rig.arming().state == ArmingState::kOff; }

  ExperimentLaw law;
  Sample newest;
  identify::Record record;
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
  ASSERT_EQ(rig.law.facts().state, ExperimentState::kDone);
  EXPECT_LE(rig.rig.peak_n, kLimitN);
  const auto found = identify::identify(rig.record, rig.law.facts());
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->fits) << found->residual_ratio;
  EXPECT_NEAR(found->mass_kg.value, kMassKg, 0.01 * kMassKg);
  EXPECT_NEAR(found->damping_n_s_per_m.value, kDampingNSPerM, 0.02 * kDampingNSPerM);
  EXPECT_NEAR(found->friction_n.value, kFrictionN, 2e-3);
  EXPECT_GT(found->delay_s.value, 0.2e-3) << "the link takes time";
  EXPECT_LT(found->delay_s.value, 3e-3);
}

// Of the kinds, those of device_lies_test.cpp that show without a wall.
TEST(IdentifyLoop, ALieEndsTheForce) {
  for (const char* kind :
       {"jump=0.05", "jump=-0.012", "runaway=12", "runaway=0.5", "slow", "no-answer", "no-output",
        "not-enabled", "no-force", "rejects", "other-force", "other-force=-1", "foreign-force"}) {
    SCOPED_TRACE(kind);
    IdentifyRig rig(std::string(kind) + "@" + std::to_string(1e-3 * kLieMs) + "+3");
    rig.rig.until_ms(kLieMs - 1);
    EXPECT_FALSE(rig.over());
    EXPECT_GT(rig.rig.last_force_us, 1000 * (kLieMs - 500)) << "it pushes before the lie";
    rig.until_over();
    const std::uint64_t end_us = rig.rig.now_us();
    EXPECT_LT(end_us, 1000 * (kLieMs + 1000));
    rig.rig.until_ms(end_us / 1000 + 4000);
    EXPECT_LT(rig.rig.last_force_us, end_us + 22'000) << "and the force stays off";
    EXPECT_LE(rig.rig.peak_n, kLimitN + 1e-9);
    const bool told = !identify::experiment_trouble(rig.law.facts().state).empty() ||
                      !arming_note_text(rig.rig.arming().note).empty();
    EXPECT_TRUE(told);
  }
}

TEST(IdentifyLoop, DisarmingEndsTheForceInTheNextTick) {
  IdentifyRig rig;
  rig.rig.until_ms(kLieMs);
  ASSERT_GT(rig.rig.last_force_us, 1000 * (kLieMs - 500));
  rig.rig.disarm();
  rig.rig.tick();
  const std::uint64_t asked_us = rig.rig.now_us();
  rig.rig.until_ms(kLieMs + 3000);
  EXPECT_LE(rig.rig.last_force_us, asked_us + 1000);
}

}  // namespace
}  // namespace hapticwall::command
