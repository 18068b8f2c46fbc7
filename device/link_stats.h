// What a link to a real device has shown so far. Trivially copyable.
#pragma once

#include <cstdint>
#include <string_view>

namespace hapticwall::device {

// Why a device gives no position that may be acted upon. Each but kNone disarms. It names what is
// so now: a link that is back, or a fault whose cause has gone, is kNone again, still disarmed.
enum class Trouble : std::uint8_t {
  kNone,
  kNotFound,     // not on the bus since the session began to look for it
  kSilent,       // no valid report for 20 ms, or it was unplugged: looked for again
  kRefused,      // found, and not to be opened or not understood; the owner's side has the words
  kRestarted,    // its clock or its sequence jumped: brought up anew
  kCalibration,  // it lost its calibration, or found one: the place of count 0 is another
  kWatchdog,     // the device heard nothing from us for too long
  kEmergencyStop,
  kOverTemperature,
  kOverCurrent,
  kEncoder,
  kOwnFault,  // one that only the device knows
};

// One clause for people: "the device was silent for 20 ms". Empty for kNone. Realtime-safe: yes.
[[nodiscard]] std::string_view trouble_text(Trouble trouble);

// Faults that the device itself holds until they are cleared. Realtime-safe: yes.
[[nodiscard]] constexpr bool is_device_fault(Trouble trouble) {
  return trouble >= Trouble::kWatchdog;
}

// All zero for a simulator. Times in seconds, counters since open().
struct LinkFigures {
  Trouble trouble = Trouble::kNone;
  bool connected = false;
  bool calibrated = false;
  bool enabled = false;              // as the device says: its amplifiers follow a command
  std::uint64_t states = 0;          // valid ones, each counted once
  std::uint64_t missing_states = 0;  // by their sequence: the device's ticks that never arrived
  std::uint64_t void_reports = 0;    // wrong length, id, CRC, major version or value
  std::uint64_t repeated_states = 0;
  std::uint64_t rejected_commands = 0;  // by the device
  std::uint64_t losses = 0;             // of the link
  double device_period_s = 0.0;         // mean time between states by the device's clock
  double age_s = 0.0;                   // of the position at the newest read()
  double maximum_age_s = 0.0;           // while the link was up
  double write_time_s = 0.0;            // of the newest command into the operating system
  double maximum_write_time_s = 0.0;
  // From the latch of a position to the arrival of the command that it led to, by the device's own
  // clock (acknowledged time minus latch time); 0: nothing is known yet.
  double round_trip_s = 0.0;
  double maximum_round_trip_s = 0.0;
  // The delay t_d of the loop through this device: from the latch to the tick at which the force
  // acted, a mean that follows the last hundred or so. 0: nothing is known yet.
  double delay_s = 0.0;
  double maximum_delay_s = 0.0;
};

}  // namespace hapticwall::device
