// What goes wrong with an emulated device, and when.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace hapticwall::device::hid {

enum class FaultKind : std::uint8_t {
  // Reports that arrive spoilt.
  kEmpty,       // a packet of no bytes
  kShort,       // cut off
  kOverLong,    // more than a report
  kWrongId,     // another id, with the right CRC
  kWrongMajor,  // another major version, with the right CRC
  kBadCrc,      // one bit of the CRC flipped
  kAllZero,     // 64 zeros
  kSkipped,     // not sent
  kRepeated,    // the one before once more, in place of the new one
  // The link.
  kSilent,     // nothing is sent; commands are heard
  kNotPolled,  // the host does not fetch reports; the next one that goes out tells of it
  kNoOutput,   // commands are not taken: whoever writes one waits
  kUnplugged,  // off the bus; power of its own goes on
  // The device.
  kFrozen,   // the firmware hangs, the amplifiers hold what they have; see FirmwareEmulator
  kRestart,  // no power: what the firmware knew is gone, the counts too
  kEmergencyStop,
  kOverTemperature,
  kOverCurrent,
  kEncoderFault,  // the counts stand still
};

// From `begin_us` on, for `duration_us`; a spoilt report is every `every`-th tick's in that time.
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
    for (const Fault& fault : faults_) {
      if (fault.kind == kind && fault.lasts_at(now_us)) return true;
    }
    return false;
  }
  // The same, of those that strike only every so many ticks.
  [[nodiscard]] bool strikes(FaultKind kind, std::uint64_t now_us, std::uint64_t tick_us) const {
    for (const Fault& fault : faults_) {
      if (fault.kind == kind && fault.lasts_at(now_us) &&
          (now_us - fault.begin_us) / tick_us % fault.every == 0) {
        return true;
      }
    }
    return false;
  }

 private:
  std::vector<Fault> faults_;
};

}  // namespace hapticwall::device::hid
