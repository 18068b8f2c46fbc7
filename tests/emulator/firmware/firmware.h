// The duties of a device's firmware by docs/hid-protocol.md: commands, time limits and faults,
// without mechanics, bus or clock. The emulator runs it; it is also a model for real firmware.
// Realtime-safe: yes, all of it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "device/link/report.h"

namespace hapticwall::device::hid {

// Input of the firmware at a tick.
struct HardwareState {
  bool bus_alive = true;     // a start of frame within the last 3 ms
  std::uint16_t faults = 0;  // present ones of kStatusFaults
};

class Firmware {
 public:
  explicit Firmware(const InfoReport& info) : info_(info) {}

  // The state after power-up.
  void restart() { *this = Firmware(info_); }

  // A packet of the output endpoint, any bytes. Takes effect at the next tick.
  void receive(std::span<const std::uint8_t> bytes, std::uint64_t clock_us);

  // Begins a tick: increments the sequence, then applies time limits and hardware faults.
  void tick(std::uint64_t clock_us, const HardwareState& hardware);

  // Command to the amplifiers from this tick on, newtons towards growing counts.
  [[nodiscard]] const std::array<double, kMaxAxes>& force_n() const { return force_n_; }

  // STATE without counts, velocities, calibration, buttons, temperature and supply, which the
  // caller adds.
  [[nodiscard]] StateReport state(std::uint64_t clock_us) const;

  [[nodiscard]] const InfoReport& info() const { return info_; }

 private:
  [[nodiscard]] bool is_acceptable(const ForceReport& command) const;
  void stop_for(std::uint16_t faults);
  void set_amplifiers(bool driven);

  InfoReport info_;
  std::uint16_t sequence_ = 0;
  // Idle: not following, no faults. Stopped: not following, with faults. Following: driven within
  // the time to live, waiting after it. A fault ends following at the tick.
  bool following_ = false;
  ForceReport command_{};  // the last one accepted
  std::uint64_t command_us_ = 0;
  std::array<double, kMaxAxes> force_n_{};
  std::uint16_t faults_ = 0;  // kept until they are cleared
  std::uint8_t first_fault_ = kNoFault;
  bool driven_ = false;
  bool saturated_ = false;
  bool rejected_ = false;
  std::uint16_t rejected_commands_ = 0;
};

}  // namespace hapticwall::device::hid
