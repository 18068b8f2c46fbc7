// State and statistics of the link to a real device.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hapticwall::device {

// Why the position of a device must not be used now. Every value except kNone disarms. When the
// link is back or the cause of the fault has gone, the value is kNone again and the force stays
// disarmed.
enum class Trouble : std::uint8_t {
  kNone,
  kNotFound,  // never seen on the bus in this session
  // No valid report for 20 ms; the search continues.
  kSilent,       // none at all, or an unplug that the kernel has not noticed yet
  kUnplugged,    // reading fails, or it is no longer on the bus
  kVoid,         // reports came, none of them valid
  kHeldUp,       // this program did not listen for all of that time
  kRefused,      // found, but cannot be opened or understood; trouble_details() says why
  kRestarted,    // its clock or its sequence jumped
  kCalibration,  // it lost or found its calibration: count 0 has moved
  kWatchdog,     // the device received no command in time
  kEmergencyStop,
  kOverTemperature,
  kOverCurrent,
  kEncoder,
  kOwnFault,  // specific to the device
};

// One clause for people, in the order of Trouble.
inline constexpr auto kTroubleTexts = std::to_array<std::string_view>({
    "",
    "no haptic device is connected",
    "the device was silent for 20 ms",
    "the device was unplugged",
    "the device sent only void reports for 20 ms",
    "this program was held up and heard no report for 20 ms",
    "the device cannot be used",
    "the device has restarted: its clock or its sequence jumped",
    "the calibration of the device has changed",
    "the watchdog of the device has expired: it received no command in time",
    "the emergency stop of the device is pressed",
    "the amplifiers of the device are too hot",
    "the amplifiers of the device draw too much current",
    "an encoder of the device has failed",
    "the device reports a fault specific to it",
});
static_assert(kTroubleTexts.size() == static_cast<std::size_t>(Trouble::kOwnFault) + 1);

// Empty for kNone. Realtime-safe: yes.
[[nodiscard]] constexpr std::string_view trouble_text(Trouble trouble) {
  return kTroubleTexts.at(static_cast<std::size_t>(trouble));
}

// Faults that the device holds until they are cleared. Realtime-safe: yes.
[[nodiscard]] constexpr bool is_device_fault(Trouble trouble) {
  return trouble >= Trouble::kWatchdog;
}

// The device's word on its force, compared with the command that the same state acknowledges.
enum class ForceWord : std::uint8_t {
  kNone,        // nothing to compare: no command of this link is acknowledged
  kSame,        // the commanded force
  kNotEnabled,  // a command enabled the amplifiers; the device says that they are off
  kNoForce,     // it says zero, and another force was commanded
  kOther,       // it says another force
  kUnasked,     // it says a force, or that it is enabled, and no command enables it
};

// All zero for a simulator. Times in seconds, counters since open(). Trivially copyable.
struct LinkStats {
  Trouble trouble = Trouble::kNone;
  bool connected = false;
  bool calibrated = false;
  bool enabled = false;  // reported: the amplifiers follow a command
  // It tells which commands it received, when, and its force. A wheel of the kernel tells nothing:
  // its delay_s is a measurement of earlier, from a device file.
  bool acknowledges = true;
  // Its states have times by a clock of its own.
  bool has_clock = false;
  std::uint64_t states = 0;          // valid ones, without repetitions
  std::uint64_t missing_states = 0;  // gaps in the sequence of the device's ticks
  std::uint64_t void_reports = 0;    // wrong length, id, CRC, major version or value
  std::uint64_t repeated_states = 0;
  std::uint64_t rejected_commands = 0;  // by the device
  // Acknowledged by a state, and the gaps between their numbers: lost, overtaken by a newer one
  // within a tick, rejected, or acknowledged by a state that is missing.
  std::uint64_t applied_commands = 0;
  std::uint64_t lost_commands = 0;
  std::uint64_t losses = 0;      // of the link
  double device_period_s = 0.0;  // mean time between states by the device's clock
  double age_s = 0.0;            // of the position at the newest read()
  double maximum_age_s = 0.0;    // while the link was up
  double write_time_s = 0.0;     // of the newest command into the operating system
  double maximum_write_time_s = 0.0;
  // Time from the latch of a position to the arrival of its command, by the device's clock; 0:
  // unknown.
  double round_trip_s = 0.0;
  double maximum_round_trip_s = 0.0;
  // Loop delay t_d: from the latch to the tick at which the force acted, averaged over about the
  // last hundred ticks. 0: unknown.
  double delay_s = 0.0;
  double maximum_delay_s = 0.0;
  double recent_delay_s = 0.0;  // of the newest acknowledgement
  // Times by the device's clock at the newest state: since it acknowledged another command, and
  // since the latch behind the command that it acknowledges. Before the first acknowledgement, they
  // count from the first state of the link.
  double unanswered_s = 0.0;
  double command_age_s = 0.0;
  ForceWord force_word = ForceWord::kNone;
  std::uint32_t same_words = 0;  // consecutive states with this word
};

}  // namespace hapticwall::device
