// The contract of a device: it gives a position and takes a force.
#pragma once

#include <string>

#include "core/result.h"
#include "core/sample.h"
#include "core/tick/device_reading.h"
#include "device/link_stats.h"

namespace hapticwall {
class PlantModel;
}

namespace hapticwall::device {

// Motion that a handle can make. A position beyond it is a fault of the device.
struct MotionLimits {
  double min_m = -0.3;
  double max_m = 0.3;
  double max_speed_m_per_s = 3.0;
  double mass_kg = 0.05;  // of the handle: a heavier one is accelerated less

  friend bool operator==(const MotionLimits&, const MotionLimits&) = default;
};

struct DeviceInfo {
  std::string name;  // for people and for the sidecar
  bool is_simulated = false;
  // Reported by a real device once it is open, for the loop's axis; 0: unknown.
  double encoder_m = 0.0;
  double force_limit_n = 0.0;           // overrides a larger one of the scene
  MotionLimits motion{};                // of a real device
  double max_force_rate_n_per_s = 0.0;  // at which a force may rise; 0: any
  std::string delay_date{};  // date of a delay that was measured in another session; else empty
  // Share of the force limit until the handle of a real device has obeyed; 1: no trial.
  double untried_share = 0.1;
};

// Call open() once, then read() and write() alternately once a tick from one thread, then close().
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  [[nodiscard]] virtual DeviceInfo info() const = 0;

  // May wait for a real device for seconds. Fails with ErrorKind::kDevice. Realtime-safe: no.
  [[nodiscard]] virtual Failure open() = 0;

  // The newest position. Realtime-safe: yes.
  [[nodiscard]] virtual DeviceReading read() = 0;

  // Commands `force_n` (newtons, positive pushes out of the wall) until the next write.
  // Precondition: finite and within the limit; the servo step ensures it. Realtime-safe: yes.
  virtual void write(double force_n) = 0;

  // Enables the actuator; disabled after open(). A simulator ignores it. Realtime-safe: yes.
  virtual void enable(bool enabled) { (void)enabled; }

  // Statistics up to the newest read(); all zero without a link. Realtime-safe: yes.
  [[nodiscard]] virtual LinkStats link() const { return {}; }

  // The present trouble in one line: path, reason, remedy; empty if there is none. Any thread.
  // Realtime-safe: no.
  [[nodiscard]] virtual std::string trouble_details() const { return {}; }

  // Zero force, then closed; harmless when not open. Realtime-safe: no.
  virtual void close() = 0;

  // Back to the start of the scene; a real device ignores it. Realtime-safe: yes.
  virtual void reset() {}

  // Moves `plant` from this tick on; it continues from the state of the previous plant. The caller
  // keeps it alive until another plant replaces it or the device is destroyed. A real device
  // ignores it. Realtime-safe: yes.
  virtual void change_plant(PlantModel& plant) { (void)plant; }

  // A pointer at this position leads the hand from now on (simulators only). Realtime-safe: yes.
  virtual void lead_hand_to(double position_m) { (void)position_m; }

  // The simulator's true state at the last read(); nullptr for a real device. Realtime-safe: yes.
  [[nodiscard]] virtual const PlantTruth* truth() const { return nullptr; }
};

}  // namespace hapticwall::device
