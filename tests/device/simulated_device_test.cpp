#include "device/simulated_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/tick/servo.h"

namespace hapticwall::device {
namespace {

constexpr double kIntoWallN = -2.0;  // into the wall
constexpr double kStepM = 0.254e-3;

Scene free_scene() {
  Scene scene;
  scene.x().device.encoder_m = kStepM;
  scene.x().device.start_m = 0.03;
  return scene;
}

Scene held_scene() {
  Scene scene = free_scene();
  HandSettings hand;
  hand.stiffness_n_per_m = 250.0;
  hand.damping_n_s_per_m = 10.0;
  hand.path = {{0.0, 0.03}, {0.1, 0.03}};
  scene.x().hand = hand;
  return scene;
}

TEST(SimulatedDevice, OneWriteIsOneTickOfThePlant) {
  const Scene scene = free_scene();
  SimulatedDevice device(scene);
  PlantModel plant(scene);
  ASSERT_FALSE(device.open());
  for (int tick = 0; tick < 200; ++tick) {
    const DeviceReading reading = device.read();
    ASSERT_EQ(reading.position_m, plant.measured_position_m()) << tick;
    ASSERT_EQ(reading.age_s, 0.0);
    ASSERT_EQ(reading.state, DeviceState::kOk);
    ASSERT_EQ(device.truth()->position_m, plant.truth().position_m) << tick;
    device.write(kIntoWallN);
    plant.advance(kIntoWallN);
  }
  EXPECT_GT(plant.truth().position_m, 0.05);
}

TEST(SimulatedDevice, ReadingTwiceDoesNotMoveItAndTruthIsThatOfTheLastRead) {
  SimulatedDevice device(free_scene());
  static_cast<void>(device.read());
  const double start_m = device.truth()->position_m;
  device.write(kIntoWallN);
  EXPECT_EQ(device.truth()->position_m, start_m);
  static_cast<void>(device.read());
  const double moved_m = device.truth()->position_m;
  EXPECT_GT(moved_m, start_m);
  static_cast<void>(device.read());
  EXPECT_EQ(device.truth()->position_m, moved_m);
}

TEST(SimulatedDevice, PositionIsCountedByTheEncoder) {
  SimulatedDevice device(free_scene());
  for (int tick = 0; tick < 100; ++tick) {
    const double position_m = device.read().position_m;
    ASSERT_EQ(position_m, kStepM * std::rint(position_m / kStepM));
    device.write(kIntoWallN);
  }
  EXPECT_NE(device.read().position_m, device.truth()->position_m);
}

TEST(SimulatedDevice, ResetForgetsEverythingAlsoTheForceJustWritten) {
  SimulatedDevice device(held_scene());
  static_cast<void>(device.read());
  const PlantTruth start = *device.truth();
  for (int tick = 0; tick < 50; ++tick) {
    device.lead_hand_to(0.06);
    static_cast<void>(device.read());
    device.write(kIntoWallN);
  }
  ASSERT_NE(device.truth()->position_m, start.position_m);
  device.reset();
  static_cast<void>(device.read());
  EXPECT_EQ(device.truth()->position_m, start.position_m);
  EXPECT_EQ(device.truth()->velocity_m_per_s, 0.0);
  EXPECT_EQ(device.truth()->actuator_work_j, 0.0);
  EXPECT_EQ(device.truth()->hand_path_m, start.hand_path_m);
}

TEST(SimulatedDevice, ThePointerLeadsTheHandUntilItIsReleased) {
  SimulatedDevice device(held_scene());
  const auto run = [&](int ticks) {
    for (int tick = 0; tick < ticks; ++tick) {
      static_cast<void>(device.read());
      device.write(0.0);
    }
    static_cast<void>(device.read());
  };
  device.lead_hand_to(0.06);
  run(2000);
  EXPECT_NEAR(device.truth()->position_m, 0.06, 1e-4);
  EXPECT_NEAR(device.truth()->hand_path_m, 0.06, 1e-12);
  device.release_hand();
  run(2000);
  EXPECT_NEAR(device.truth()->position_m, 0.03, 1e-4);
}

TEST(SimulatedDevice, ANewPlantGoesOnWhereTheOldOneIsAfterTheTickThatPasses) {
  Scene heavy = held_scene();
  heavy.x().device.mass_kg = 0.4;
  PlantModel before(held_scene());
  PlantModel after(heavy);
  PlantModel next(heavy);
  SimulatedDevice device(held_scene());
  for (int tick = 0; tick < 100; ++tick) {
    static_cast<void>(device.read());
    if (tick < 50) {
      ASSERT_EQ(device.truth()->position_m, before.truth().position_m) << tick;
      before.advance(kIntoWallN);
    }
    device.write(kIntoWallN);
    if (tick == 49) {
      device.change_plant(next);  // the force of tick 49 acts on the plant before
      after.take_over(before);
    }
    if (tick >= 50) {
      ASSERT_EQ(device.truth()->position_m, after.truth().position_m) << tick;
      ASSERT_EQ(device.truth()->kinetic_j, after.truth().kinetic_j) << tick;
      after.advance(kIntoWallN);
    }
  }
  EXPECT_NE(after.truth().velocity_m_per_s, 0.0);
  device.reset();
  EXPECT_EQ(device.read().position_m, PlantModel(heavy).measured_position_m());
}

TEST(Device, OneWithAPlantOfItsOwnIgnoresAnother) {
  class RealDevice : public Device {
   public:
    [[nodiscard]] DeviceInfo info() const override { return {"real", false}; }
    [[nodiscard]] Failure open() override { return std::nullopt; }
    [[nodiscard]] DeviceReading read() override { return {0.04, 0.0, DeviceState::kOk}; }
    void write(double force_n) override { (void)force_n; }
    void close() override {}
  } device;
  PlantModel plant(held_scene());
  device.change_plant(plant);
  EXPECT_EQ(device.read().position_m, 0.04);
  EXPECT_EQ(device.truth(), nullptr);
}

// The force of an unstable wall without a limit would overflow.
TEST(SimulatedDevice, OutsideTheWorkspaceItIsAtFaultAndStaysFinite) {
  Scene scene = held_scene();
  scene.x().walls = {{0.03, 1e8, 0.0}};
  scene.x().hand->path = {{0.0, 0.031}};
  scene.x().device.start_m = 0.031;
  SimulatedDevice device(scene);
  Servo servo(servo_settings(scene));
  bool fault = false;
  for (int tick = 0; tick < 20'000; ++tick) {
    const Sample sample = servo.tick(device);
    ASSERT_TRUE(std::isfinite(sample.position_m) && std::isfinite(sample.truth.position_m) &&
                std::isfinite(sample.truth.kinetic_j) && std::isfinite(sample.force_n));
    if ((sample.flags & kFlagDeviceFault) == 0) continue;
    fault = true;
    ASSERT_EQ(sample.force_n, 0.0);
  }
  EXPECT_TRUE(fault);
}

TEST(SimulatedDevice, SaysWhatItIs) {
  SimulatedDevice device(free_scene());
  EXPECT_TRUE(device.info().is_simulated);
  EXPECT_EQ(device.info().name, "simulator");
  device.close();
  device.close();
}

// A live loop then commands no force, and each tick is short.
TEST(SimulatedDevice, APlantThatGivesUpIsAFaultUntilReset) {
  Scene scene = held_scene();
  scene.sampling.rate_hz = 228.918;
  scene.x().device.encoder_m.reset();
  scene.x().device.mass_kg = 0.0145;
  scene.x().device.damping_n_s_per_m = 0.02;
  scene.x().device.friction_n = 0.004;
  scene.x().hand = HandSettings{
      3.25e-6, 7200.0, 21.0, 3.18e6, 3700.0, {{0.0, 0.03}, {0.1, 0.06}, {0.2, 0.02}}, false};
  SimulatedDevice device(scene);
  int ticks = 0;
  for (DeviceReading now = device.read(); now.state == DeviceState::kOk; now = device.read()) {
    ASSERT_LT(++ticks, 1000);
    device.write(std::max(0.0, 41e3 * (now.position_m - 0.05)));
  }
  device.write(0.0);
  EXPECT_EQ(device.read().state, DeviceState::kFault);
  device.reset();
  EXPECT_EQ(device.read().state, DeviceState::kOk);
}

}  // namespace
}  // namespace hapticwall::device
