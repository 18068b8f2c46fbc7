// Devices that fail in every way, and that judge every force as they hear it.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "device/simulated_device.h"

namespace hapticwall::testing {

using device::DeviceInfo;

// Counts of all lives together, so that a test can tell that it has tested something.
struct LifeTotals {
  std::uint64_t lives = 0;
  std::uint64_t cycles = 0;
  std::uint64_t ticks_with_force = 0;
  std::uint64_t ticks_at_limit = 0;
  std::uint64_t ticks_in_ramp_with_force = 0;
  std::uint64_t changes_under_force = 0;
  std::uint64_t armings = 0;
  std::uint64_t faults = 0;  // readings that must not be acted upon
  std::uint64_t holes = 0;   // the loop was held up for longer than a force may stand
  std::uint64_t absurd_positions = 0;
  std::uint64_t exceptions = 0;
  std::uint64_t forces_taken_away = 0;  // there was one in the cycle before the trouble
};

// The first promise that was broken: the loop lets no exception out that could tell of it.
struct Broken {
  std::string promise;  // none: empty
  void unless(bool holds, const char* what) {
    if (!holds && promise.empty()) promise = what;
  }
};

// The forces that a device heard, judged as they come in.
struct Commands {
  Broken broken;
  std::vector<double> of_cycle_n;
  double newest_n = 0.0;
  bool enabled = false;
  bool closed = false;
  bool throws_at_read = false;
  bool throws_at_write = false;

  void write(double force_n) {
    if (throws_at_write) {
      throws_at_write = false;  // a loose contact: the next one is heard
      throw std::runtime_error("write");
    }
    broken.unless(std::isfinite(force_n), "finite");
    broken.unless(!closed, "nothing after the end");
    of_cycle_n.push_back(force_n);
    newest_n = force_n;
  }
};

// A real one: somebody moves its handle, and its readings are good or not.
// Its handle is anywhere: plausible motion is tested elsewhere.
class FaultyDevice : public device::Device {
 public:
  [[nodiscard]] DeviceInfo info() const override {
    return {"faulty", false, 0.0, 0.0, kAnywhere, 0.0, "", 1.0};
  }
  [[nodiscard]] Failure open() override { return std::nullopt; }
  [[nodiscard]] DeviceReading read() override {
    if (commands.throws_at_read) throw std::runtime_error("read");
    return reading;
  }
  void write(double force_n) override { commands.write(force_n); }
  void enable(bool enabled) override { commands.enabled = enabled; }
  void close() override { commands.closed = true; }

  static constexpr double kFar = std::numeric_limits<double>::infinity();
  static constexpr device::MotionLimits kAnywhere{-kFar, kFar, kFar};

  Commands commands;
  DeviceReading reading;
};

class FaultySimulator : public device::SimulatedDevice {
 public:
  using SimulatedDevice::SimulatedDevice;
  [[nodiscard]] DeviceReading read() override {
    if (commands.throws_at_read) throw std::runtime_error("read");
    return SimulatedDevice::read();
  }
  void write(double force_n) override {
    commands.write(force_n);
    SimulatedDevice::write(force_n);
  }
  void close() override { commands.closed = true; }

  Commands commands;
};

}  // namespace hapticwall::testing
