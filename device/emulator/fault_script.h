// The faults of an emulated device, and their times.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace hapticwall::device::hid {

enum class FaultKind : std::uint8_t {
  // Corrupt reports.
  kEmpty,       // a packet without bytes
  kShort,       // truncated
  kOverLong,    // longer than a report
  kWrongId,     // another id, with the right CRC
  kWrongMajor,  // another major version, with the right CRC
  kBadCrc,      // one bit of the CRC flipped
  kAllZero,     // 64 zeros
  kSkipped,     // not sent
  kRepeated,    // the previous report instead of the new one
  // The link.
  kSilent,     // sends nothing, still takes commands
  kNotPolled,  // the host fetches no reports; the next one sent flags the overrun
  kNoOutput,   // takes no commands: writes block
  kUnplugged,  // off the bus, still powered
  // The device.
  kFrozen,   // the firmware hangs, and the amplifiers hold their force until the watchdog resets it
  kRestart,  // power loss: firmware state and counts are lost
  kEmergencyStop,
  kOverTemperature,
  kOverCurrent,
  kEncoderFault,  // the counts freeze
};

// Lasts `duration_us` from `begin_us`; corrupts the report of every `every`-th tick.
struct Fault {
  FaultKind kind = FaultKind::kSilent;
  std::uint64_t begin_us = 0;
  std::uint64_t duration_us = 0;
  std::uint32_t every = 1;

  [[nodiscard]] bool lasts_at(std::uint64_t now_us) const {
    return now_us >= begin_us && now_us - begin_us < duration_us;
  }
};

class FaultScript {
 public:
  FaultScript() = default;
  FaultScript(std::initializer_list<Fault> faults) : faults_(faults) {}
  explicit FaultScript(std::vector<Fault> faults) : faults_(std::move(faults)) {}

  // Realtime-safe: yes, both.
  [[nodiscard]] bool lasts(FaultKind kind, std::uint64_t now_us) const {
    return std::ranges::any_of(
        faults_, [&](const Fault& fault) { return fault.kind == kind && fault.lasts_at(now_us); });
  }
  // The same for faults that strike every `every`-th tick.
  [[nodiscard]] bool strikes(FaultKind kind, std::uint64_t now_us, std::uint64_t tick_us) const {
    return std::ranges::any_of(faults_, [&](const Fault& fault) {
      return fault.kind == kind && fault.lasts_at(now_us) &&
             (now_us - fault.begin_us) / tick_us % fault.every == 0;
    });
  }

 private:
  std::vector<Fault> faults_;
};

}  // namespace hapticwall::device::hid
