// The core's plant behind the device contract.
//
// Its time is virtual: one write() is one tick, however long the wall clock took over it. A loop
// that misses a deadline slows the simulation down and does not change it, which is why a live
// session gives the same bits as a headless run.
#pragma once

#include <optional>

#include "core/plant/plant_model.h"
#include "core/scene.h"
#include "device/device.h"

namespace hapticwall::device {

class SimulatedDevice : public Device {
 public:
  // Precondition: validate(scene) gives nothing. Realtime-safe: no.
  explicit SimulatedDevice(const Scene& scene);

  [[nodiscard]] DeviceInfo info() const override;
  [[nodiscard]] Failure open() override;
  // The position at the present tick. After a write() the plant first moves on by one tick under
  // that force; a second read() without one in between gives the same again. A plant that has left
  // the workspace (where a headless run ends as diverged) is a fault: the loop then commands no
  // force, and the numbers stay finite.
  [[nodiscard]] DeviceReading read() override;
  void write(double force_n) override;
  void close() override;
  void reset() override;
  // The tick that is passing belongs to the plant before.
  void change_plant(PlantModel& plant) override;
  void lead_hand_to(double position_m) override;
  void release_hand() override;
  [[nodiscard]] const PlantTruth* truth() const override;

 private:
  void pass_tick();

  PlantModel first_plant_;
  PlantModel* plant_ = &first_plant_;
  // Written and not yet acted upon: truth() stays that of the last read() until the next one.
  std::optional<double> held_force_n_;
};

}  // namespace hapticwall::device
