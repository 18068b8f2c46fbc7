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

class SimulatedDevice : public Device {
 public:
  // Precondition: the scene is valid. Realtime-safe: no.
  explicit SimulatedDevice(const Scene& scene);

  [[nodiscard]] DeviceInfo info() const override;
  [[nodiscard]] Failure open() override;
  // The position at the present tick. The first read() after a write() advances the plant by one
  // tick; further ones return the same value. A diverged plant reads as a fault, so that the loop
  // commands no force and the numbers stay finite.
  [[nodiscard]] DeviceReading read() override;
  void write(double force_n) override;
  void close() override;
  void reset() override;
  // The previous plant finishes the present tick.
  void change_plant(PlantModel& plant) override;
  void lead_hand_to(double position_m) override;
  void release_hand() override;
  [[nodiscard]] const PlantTruth* truth() const override;

 private:
  void pass_tick();

  PlantModel first_plant_;
  PlantModel* plant_ = &first_plant_;
  // Written, but not applied before the next read(): truth() stays that of the last read().
  std::optional<double> held_force_n_;
};

}  // namespace hapticwall::device
