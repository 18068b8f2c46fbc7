#include "tests/emulator/firmware/firmware.h"

#include <algorithm>
#include <utility>

namespace hapticwall::device::hid {
namespace {

constexpr std::uint64_t kMicrosecondsPerMillisecond = 1000;

// The code of one of the faults; 0 without faults.
std::uint8_t code_of(std::uint16_t faults) {
  constexpr std::array<std::pair<StatusFlag, FaultCode>, 5> kCodes{
      {{kStatusEmergencyStop, kFaultEmergencyStop},
       {kStatusOverTemperature, kFaultOverTemperature},
       {kStatusOverCurrent, kFaultOverCurrent},
       {kStatusEncoderFault, kFaultEncoder},
       {kStatusWatchdog, kFaultWatchdog}}};
  for (const auto& [flag, code] : kCodes) {
    if ((faults & flag) != 0) return code;
  }
  return kNoFault;
}

}  // namespace

bool Firmware::is_acceptable(const ForceReport& command) const {
  if (!command.enable) return true;
  if (command.clear_faults) return false;
  if (following_ && sequence_step(command_.sequence, command.sequence) <= 0) return false;
  const auto ticks = static_cast<std::uint16_t>(sequence_ - command.echoed_state_sequence);
  return std::uint64_t{ticks} * info_.tick_us <=
         command.time_to_live_ms * kMicrosecondsPerMillisecond;
}

void Firmware::receive(std::span<const std::uint8_t> bytes, std::uint64_t clock_us) {
  const Decoded<ForceReport> decoded = decode_force(bytes);
  const ForceReport* command = decoded.report();
  rejected_ = command == nullptr || !is_acceptable(*command);
  if (rejected_) {
    ++rejected_commands_;
    return;
  }
  command_ = *command;
  command_us_ = clock_us;
  if (command->clear_faults) faults_ = 0;  // the tick sets those whose cause lasts
  following_ = command->enable;
}

void Firmware::stop_for(std::uint16_t faults) {
  if (faults_ == 0) first_fault_ = code_of(faults);
  faults_ |= faults;
}

void Firmware::tick(std::uint64_t clock_us, const HardwareState& hardware) {
  ++sequence_;
  stop_for(hardware.faults & kStatusFaults);
  if (!hardware.bus_alive) following_ = false;
  const std::uint64_t age_us = clock_us - command_us_;
  if (following_ && age_us >= info_.watchdog_ms * kMicrosecondsPerMillisecond) {
    stop_for(kStatusWatchdog);
  }
  if (faults_ != 0) following_ = false;
  set_amplifiers(following_ && age_us < command_.time_to_live_ms * kMicrosecondsPerMillisecond);
}

void Firmware::set_amplifiers(bool driven) {
  driven_ = driven;
  saturated_ = false;
  force_n_ = {};
  if (!driven) return;
  for (std::size_t axis = 0; axis < info_.axes; ++axis) {
    const double most_n = info_.maximum_force_n[axis];
    force_n_[axis] = std::clamp(command_.force_n[axis], -most_n, most_n);
    saturated_ = saturated_ || force_n_[axis] != command_.force_n[axis];
  }
}

StateReport Firmware::state(std::uint64_t clock_us) const {
  StateReport state;
  state.sequence = sequence_;
  state.time_us = static_cast<std::uint32_t>(clock_us);
  state.applied_force_n = force_n_;
  const auto flag = [](bool set, std::uint16_t bit) { return set ? bit : std::uint16_t{0}; };
  state.status = static_cast<std::uint16_t>(faults_ | flag(driven_, kStatusEnabled) |
                                            flag(saturated_, kStatusSaturated) |
                                            flag(rejected_, kStatusCommandRejected));
  state.acknowledged_sequence = command_.sequence;
  state.acknowledged_time_us = static_cast<std::uint32_t>(command_us_);
  state.fault = first_fault_;
  state.rejected_commands = rejected_commands_;
  return state;
}

}  // namespace hapticwall::device::hid
