#include "core/servo.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
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

}  // namespace
}  // namespace hapticwall
