#include "core/loop/servo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace hapticwall {
namespace {

// Gives the positions that a test names and keeps the forces that it gets.
class ScriptedDevice {
 public:
  DeviceReading read() { return next; }
  void write(double force_n) { forces.push_back(force_n); }

  DeviceReading next;
  std::vector<double> forces;
};

ServoSettings stiff_wall(std::string_view algorithm = "none") {
  ServoSettings settings;
  const std::array<WallSettings, 1> walls{WallSettings{0.0, 35e3, 0.0}};
  settings.walls = WallSet(walls);
  settings.device_damping_n_s_per_m = 1.0;
  settings.force_limit_n = 8.9;
  settings.algorithm.index = *find_algorithm(algorithm);
  return settings;
}

TEST(ServoStep, CommandsTheWallForceAndClampsIt) {
  Servo servo(stiff_wall());
  ScriptedDevice device;
  device.next.position_m = 0.1e-3;
  Sample sample = servo.tick(device);
  EXPECT_NEAR(device.forces.back(), 3.5, 1e-12);
  EXPECT_EQ(sample.flags, static_cast<std::uint32_t>(kFlagInContact));
  device.next.position_m = 1e-3;
  sample = servo.tick(device);
  EXPECT_EQ(device.forces.back(), 8.9);
  EXPECT_EQ(sample.flags, static_cast<std::uint32_t>(kFlagInContact | kFlagForceLimit));
  EXPECT_NEAR(sample.wall_force_n, 35.0, 1e-12);
  EXPECT_NEAR(sample.stiffness_n_per_m, 8900.0, 1e-9);
}

TEST(ServoStep, OldOrFaultyInputMeansZeroForce) {
  for (const DeviceReading bad :
       {DeviceReading{1e-4, 0.021, DeviceState::kOk},
        DeviceReading{1e-4, std::nan(""), DeviceState::kOk},
        DeviceReading{1e-4, 0.0, DeviceState::kFault},
        DeviceReading{std::nan(""), 0.0, DeviceState::kOk},
        DeviceReading{std::numeric_limits<double>::infinity(), 0.0, DeviceState::kOk}}) {
    Servo servo(stiff_wall());
    ScriptedDevice device;
    device.next.position_m = 1e-4;
    servo.tick(device);
    ASSERT_GT(device.forces.back(), 0.0);
    device.next = bad;
    const Sample sample = servo.tick(device);
    EXPECT_EQ(device.forces.back(), 0.0);
    EXPECT_NE(sample.flags & (kFlagStaleInput | kFlagDeviceFault), 0U);
    EXPECT_TRUE(std::isfinite(sample.position_m));
    device.next = {1e-4, 0.0, DeviceState::kOk};
    servo.tick(device);
    EXPECT_GT(device.forces.back(), 0.0);
  }
}

TEST(ServoStep, AForceThatIsNotFiniteIsZeroUntilReset) {
  ServoSettings settings = stiff_wall();
  const std::array<WallSettings, 1> walls{WallSettings{0.0, 1e308, 1e308}};
  settings.walls = WallSet(walls);
  Servo servo(settings);
  ScriptedDevice device;
  device.next.position_m = 1e4;
  servo.tick(device);
  EXPECT_EQ(device.forces.back(), 0.0);
  EXPECT_TRUE(servo.state().failed);
  device.next.position_m = 0.0;
  servo.tick(device);
  device.next.position_m = 1e-300;
  servo.tick(device);
  EXPECT_EQ(device.forces.back(), 0.0);
  servo.reset();
  servo.tick(device);
  EXPECT_GT(device.forces.back(), 0.0);
}

TEST(Servo, ASwitchStartsFromTheForceThatWasThere) {
  for (const AlgorithmDescription& from : algorithms()) {
    for (const AlgorithmDescription& to : algorithms()) {
      if (from.name == to.name) continue;  // no switch
      Servo servo(stiff_wall(from.name));
      ScriptedDevice device;
      for (int i = 0; i < 100; ++i) {
        device.next.position_m = 1e-4 + 1e-6 * i;
        servo.tick(device);
      }
      const double before = device.forces.back();
      ASSERT_GT(before, 0.0);
      servo.apply(stiff_wall(to.name));
      device.next.position_m += 1e-6;
      const Sample sample = servo.tick(device);
      EXPECT_NEAR(device.forces.back(), before, 1e-12) << from.name << " to " << to.name;
      EXPECT_NE(sample.flags & kFlagParametersChanged, 0U);
      EXPECT_EQ(servo.tick(device).flags & kFlagParametersChanged, 0U);
    }
  }
}

TEST(Servo, AChangedWallDoesNotKickEither) {
  Servo servo(stiff_wall());
  ScriptedDevice device;
  device.next.position_m = 1e-4;
  servo.tick(device);
  ServoSettings moved = stiff_wall();
  const std::array<WallSettings, 1> walls{WallSettings{-1e-4, 35e3, 0.0}};
  moved.walls = WallSet(walls);
  servo.apply(moved);
  servo.tick(device);
  EXPECT_NEAR(device.forces.back(), 3.5, 1e-12);
  double previous = device.forces.back();
  for (int i = 0; i < 60; ++i) {
    servo.tick(device);
    EXPECT_LE(std::abs(device.forces.back() - previous), 3.5 / 50 + 1e-12);
    previous = device.forces.back();
  }
  EXPECT_NEAR(previous, 7.0, 1e-12);
}

TEST(Servo, AfterTheTransitionTheNewAlgorithmIsAlone) {
  Servo servo(stiff_wall("none"));
  ScriptedDevice device;
  device.next.position_m = 2e-4;
  servo.tick(device);
  servo.apply(stiff_wall("virtual-coupling"));
  for (int i = 0; i < 50; ++i) servo.tick(device);
  servo.tick(device);
  EXPECT_NEAR(device.forces.back(), 2e-4 * 35e3 * 2e3 / 37e3, 1e-12);
}

TEST(Servo, ResetStartsAtTickZeroWithEmptyLedger) {
  Servo servo(stiff_wall("energy-bounding"));
  ScriptedDevice device;
  for (int i = 0; i < 10; ++i) {
    device.next.position_m = 1e-5 * i;
    servo.tick(device);
  }
  servo.reset();
  device.next.position_m = 5e-5;
  const Sample sample = servo.tick(device);
  EXPECT_EQ(sample.tick, 0U);
  EXPECT_EQ(sample.velocity_m_per_s, 0.0);
  EXPECT_EQ(sample.energy_cv_j, 0.0);
}

// Without a first position there is no displacement either: what comes after a faulty start is no
// leap from 0.
TEST(ServoStep, AFaultyStartIsNoMotion) {
  Servo servo(stiff_wall());
  ScriptedDevice device;
  device.next = {std::nan(""), 0.0, DeviceState::kOk};
  servo.tick(device);
  device.next = {1e-4, 0.0, DeviceState::kOk};
  const Sample sample = servo.tick(device);
  EXPECT_EQ(sample.velocity_m_per_s, 0.0);
  EXPECT_EQ(sample.energy_cv_j, 0.0);
  EXPECT_EQ(sample.energy_budget_j, 0.0);
  device.next.position_m = 2e-4;
  EXPECT_NEAR(servo.tick(device).velocity_m_per_s, 0.1, 1e-12);
}

TEST(ServoStep, TheFirstTickHasNoVelocityWhereverItIs) {
  Servo servo(stiff_wall());
  ScriptedDevice device;
  device.next.position_m = 0.03;
  EXPECT_EQ(servo.tick(device).velocity_m_per_s, 0.0);
}

TEST(ServoStep, ActsOnAPositionOfTheGreatestAge) {
  Servo servo(stiff_wall());
  ScriptedDevice device;
  device.next = {1e-4, kDefaultMaxAgeS, DeviceState::kOk};
  EXPECT_EQ(servo.tick(device).flags & kFlagStaleInput, 0U);
  EXPECT_GT(device.forces.back(), 0.0);
}

struct ConstantForce {
  double force_n = 0.0;
  [[nodiscard]] double step(const StabiliserInput& /*input*/) const { return force_n; }
};

TEST(ServoStep, ClampsAPullAsItClampsAPush) {
  for (const double wanted_n : {-100.0, -8.9, -3.0, 0.0, 3.5, 100.0}) {
    ServoState state;
    ConstantForce stabiliser{wanted_n};
    ScriptedDevice device;
    device.next.position_m = 1e-4;  // the wall asks for 3.5 N
    const TickOutcome out = servo_step(stiff_wall(), state, stabiliser, device);
    EXPECT_EQ(device.forces.back(), std::clamp(wanted_n, -8.9, 8.9));
    EXPECT_EQ(out.saturated, std::abs(wanted_n) > 8.9) << wanted_n;
    EXPECT_EQ(out.intervened, wanted_n != out.contact.force_n) << wanted_n;
    EXPECT_EQ(state.previous_force_n, device.forces.back());
  }
}

TEST(ServoStep, TellsWhetherTheAlgorithmIntervened) {
  for (const char* algorithm : {"none", "virtual-coupling"}) {
    Servo servo(stiff_wall(algorithm));
    ScriptedDevice device;
    device.next.position_m = 1e-4;
    const Sample sample = servo.tick(device);
    EXPECT_EQ((sample.flags & kFlagIntervened) != 0U, sample.force_n != sample.wall_force_n);
    EXPECT_EQ((sample.flags & kFlagIntervened) != 0U, std::string_view(algorithm) != "none");
  }
}

TEST(Servo, TheBudgetIsThatOfTheBelievedDamping) {
  ServoSettings settings = stiff_wall();
  settings.algorithm.values.at(*find_algorithm_parameter("damping_n_s_per_m")) = 3.0;
  Servo servo(settings);
  ScriptedDevice device;
  servo.tick(device);
  device.next.position_m = -1e-4;
  EXPECT_NEAR(servo.tick(device).energy_budget_j, -3.0 * 1e-8 / 1e-3, 1e-18);  // b Δx²/T
}

// Passivity control remembers the deficit of an earlier contact, unless it was switched in between.
TEST(Servo, ASwitchForgetsWhatTheAlgorithmRemembered) {
  ServoSettings controlled = stiff_wall("passivity-control");
  controlled.algorithm.values.at(*find_algorithm_parameter("observer")) = 1.0;
  Servo servo(controlled);
  ScriptedDevice device;
  for (const double position_m : {0.0, 2e-4, -2e-4}) {
    device.next.position_m = position_m;
    servo.tick(device);
  }
  servo.apply(stiff_wall("none"));
  for (int i = 0; i < 60; ++i) servo.tick(device);
  servo.apply(controlled);
  for (int i = 0; i < 60; ++i) servo.tick(device);
  device.next.position_m = 1e-4;
  EXPECT_EQ(servo.tick(device).flags & kFlagIntervened, 0U);
}

}  // namespace
}  // namespace hapticwall
