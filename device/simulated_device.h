// The core's plant behind the device contract.
//
// Time is virtual: each write() is one tick. A missed deadline slows the simulation without
// changing it, so a live session gives the same bits as a headless run.
#pragma once

#include <optional>

#include "core/plant/plant_model.h"
#include "core/scene.h"
#include "device/device.h"

namespace hapticwall::device {

// One thread. Realtime-safe: yes, except the constructor.
class SimulatedDevice : public Device {
 public:
  // Precondition: the scene is valid. Realtime-safe: no.
  explicit SimulatedDevice(const Scene& scene) : first_plant_(scene) {}

  [[nodiscard]] DeviceInfo info() const override { return {"simulator", true}; }
  [[nodiscard]] Failure open() override { return std::nullopt; }
  // The position at the present tick. The first read() after a write() advances the plant by one
  // tick; further ones return the same value. A diverged plant reads as a fault, so that the loop
  // commands no force and the numbers stay finite.
  [[nodiscard]] DeviceReading read() override {
    pass_tick();
    return {plant_->measured_position_m(), 0.0,
            plant_->has_diverged() ? DeviceState::kFault : DeviceState::kOk};
  }
  void write(double force_n) override { held_force_n_ = force_n; }
  void close() override { held_force_n_.reset(); }
  void reset() override {
    held_force_n_.reset();
    plant_->reset();
  }
  // The previous plant finishes the present tick.
  void change_plant(PlantModel& plant) override {
    pass_tick();
    plant.take_over(*plant_);
    plant_ = &plant;
  }
  void lead_hand_to(double position_m) override { plant_->lead_hand_to(position_m); }
  // The hand follows its scripted path again, as in recordings of programs that could release it.
  // Realtime-safe: yes.
  void release_hand() { plant_->release_hand(); }
  [[nodiscard]] const PlantTruth* truth() const override { return &plant_->truth(); }

 private:
  void pass_tick() {
    if (!held_force_n_) return;
    plant_->advance(*held_force_n_);
    held_force_n_.reset();
  }

  PlantModel first_plant_;
  PlantModel* plant_ = &first_plant_;
  // Written, but not applied before the next read(): truth() stays that of the last read().
  std::optional<double> held_force_n_;
};

}  // namespace hapticwall::device
