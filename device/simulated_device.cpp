#include "device/simulated_device.h"

namespace hapticwall::device {

SimulatedDevice::SimulatedDevice(const Scene& scene) : first_plant_(scene) {}

DeviceInfo SimulatedDevice::info() const { return {"simulator", true}; }

Failure SimulatedDevice::open() { return std::nullopt; }

void SimulatedDevice::pass_tick() {
  if (!held_force_n_) return;
  plant_->advance(*held_force_n_);
  held_force_n_.reset();
}

DeviceReading SimulatedDevice::read() {
  pass_tick();
  return {plant_->measured_position_m(), 0.0,
          plant_->has_diverged() ? DeviceState::kFault : DeviceState::kOk};
}

void SimulatedDevice::write(double force_n) { held_force_n_ = force_n; }

void SimulatedDevice::close() { held_force_n_.reset(); }

void SimulatedDevice::reset() {
  held_force_n_.reset();
  plant_->reset();
}

void SimulatedDevice::change_plant(PlantModel& plant) {
  pass_tick();
  plant.take_over(*plant_);
  plant_ = &plant;
}

void SimulatedDevice::lead_hand_to(double position_m) { plant_->lead_hand_to(position_m); }

void SimulatedDevice::release_hand() { plant_->release_hand(); }

const PlantTruth* SimulatedDevice::truth() const { return &plant_->truth(); }

}  // namespace hapticwall::device
