// The contract of whatever gives a position and takes a force.
#pragma once

#include <string>

#include "core/device_reading.h"
#include "core/result.h"
#include "core/sample.h"
#include "device/link_figures.h"

namespace hapticwall {
class PlantModel;
}

namespace hapticwall::device {

struct DeviceInfo {
  std::string name;  // for people and for the sidecar
  bool is_simulated = false;
  // What a real device knows of itself once it is open, for the loop's axis; 0: nothing.
  double encoder_m = 0.0;
  double force_limit_n = 0.0;  // smaller than the scene's: it holds
};

// Life: open() once, then read() and write() in turn once a tick from one thread, then close().
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  [[nodiscard]] virtual DeviceInfo info() const = 0;

  // Realtime-safe: no.
  [[nodiscard]] virtual Failure open() = 0;

  // The newest position. Realtime-safe: yes.
  [[nodiscard]] virtual DeviceReading read() = 0;

  // Commands `force_n` (newtons, positive pushes out of the wall) until the next write.
  // Precondition: finite and within the limit (the servo step sees to it). Realtime-safe: yes.
  virtual void write(double force_n) = 0;

  // Whether the force of the next writes may act at all; not, after open(). A real device tells its
  // amplifiers so, a simulator has none to tell. Realtime-safe: yes.
  virtual void enable(bool enabled) { (void)enabled; }

  // What the link has shown up to the newest read(); all zero where there is none. Realtime-safe:
  // yes.
  [[nodiscard]] virtual LinkFigures link() const { return {}; }

  // What trouble there is now, in one line for people: the path, the reason, what would help. Empty
  // where all is well. Any thread. Realtime-safe: no.
  [[nodiscard]] virtual std::string trouble_details() const { return {}; }

  // Zero force, then closed; harmless when not open. Realtime-safe: no.
  virtual void close() = 0;

  // Back to the start of the scene; a real device ignores it. Realtime-safe: yes.
  virtual void reset() {}

  // From this tick on `plant` is what moves; it takes over from the one before, where that is and
  // with what is under way. A real device has a plant of its own and ignores it. The plant stays
  // the caller's: it lives until another one has replaced it, or the device is gone.
  // Realtime-safe: yes.
  virtual void change_plant(PlantModel& plant) { (void)plant; }

  // The hand is led by a pointer at this position from now on (simulators only). Realtime-safe:
  // yes.
  virtual void lead_hand_to(double position_m) { (void)position_m; }

  // The hand follows its scripted path (again). Realtime-safe: yes.
  virtual void release_hand() {}

  // What only a simulator knows, at the instant of the last read(); nullptr from a real device.
  // Realtime-safe: yes.
  [[nodiscard]] virtual const PlantTruth* truth() const { return nullptr; }
};

}  // namespace hapticwall::device
