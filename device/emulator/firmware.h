// What the firmware of a device must do with commands, time and faults: the duties of
// docs/hid-protocol.md, without mechanics, bus or clock of its own.
//
// It is how the emulator behaves, and a model for those who write one. Realtime-safe: yes, all of
// it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "device/hid_report.h"

namespace hapticwall::device::hid {

// What the hardware tells the firmware at a tick.
struct HardwareState {
  bool bus_alive = true;     // a start of frame within the last 3 ms
  std::uint16_t faults = 0;  // those of kStatusFaults that are there now
};

class Firmware {
 public:
  explicit Firmware(const InfoReport& info) : info_(info) {}

  // As after power-up: nothing is known of what was.
  void restart() { *this = Firmware(info_); }

  // A packet of the output endpoint: any bytes. It acts at the next tick.
  void receive(std::span<const std::uint8_t> bytes, std::uint64_t clock_us);

  // Begins a tick: one up with the sequence, then all that time and hardware ask for.
  void tick(std::uint64_t clock_us, const HardwareState& hardware);

  // What the amplifiers are told from this tick on, newtons towards growing counts.
  [[nodiscard]] const std::array<double, kMostAxes>& force_n() const { return force_n_; }

  // All of STATE that firmware alone knows; counts, velocities, calibration, buttons, temperature
  // and supply are the caller's.
  [[nodiscard]] StateReport state(std::uint64_t clock_us) const;

  [[nodiscard]] const InfoReport& info() const { return info_; }

 private:
  [[nodiscard]] bool is_acceptable(const ForceReport& command) const;
  void stop_for(std::uint16_t faults);
  void set_amplifiers(bool driven);

  InfoReport info_;
  std::uint16_t sequence_ = 0;
  // Idle is not following without faults, stopped is not following with some (a fault ends it at
  // the tick). Following is driven while the time to live lasts, waiting after it.
  bool following_ = false;
  ForceReport command_{};  // the last one accepted
  std::uint64_t command_us_ = 0;
  std::array<double, kMostAxes> force_n_{};
  std::uint16_t faults_ = 0;  // until they are cleared
  std::uint8_t first_fault_ = kNoFault;
  bool driven_ = false;
  bool saturated_ = false;
  bool rejected_ = false;
  std::uint16_t rejected_commands_ = 0;
};

}  // namespace hapticwall::device::hid
