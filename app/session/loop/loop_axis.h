// One axis of the loop: its device, its controller, its plant, and the judge of a real device.
#pragma once

#include <optional>

#include "app/session/loop/arming.h"
#include "app/session/loop/device_judge.h"
#include "core/tick/servo.h"
#include "device/device.h"

namespace hapticwall::session {

// Gives the servo step a reading that was taken before.
struct ReadDevice {
  device::Device& device;
  DeviceReading reading;

  [[nodiscard]] DeviceReading read() const { return reading; }
  void write(double force_n) { device.write(force_n); }
  [[nodiscard]] const PlantTruth* truth() const { return device.truth(); }
};

struct LoopAxis {
  device::Device& device;
  Servo servo;
  PlantModel* plant = nullptr;         // plant in use; nullptr: the device's own
  std::optional<DeviceJudge> judge{};  // nullopt: a simulator
  ArmingNote judged = ArmingNote::kNone;

  // Realtime-safe: yes, every member.
  void apply(const ServoSettings& settings, PlantModel* new_plant);
  void reset();
  // The sample before tick 0: the device's rest position, no force, no energies.
  [[nodiscard]] Sample at_rest();
  // Reads the device for the next tick, whose force has this gain. A real device is judged: an
  // objection removes the force in the same tick.
  [[nodiscard]] ReadDevice read(double elapsed_s, double gain, bool armed);

 private:
  void judge_reading(DeviceReading& reading, double elapsed_s, bool armed);
};

}  // namespace hapticwall::session
