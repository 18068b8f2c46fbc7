// The faults of an emulated device, and their times.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
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
  // Lies: well-formed and wrong.
  kJump,            // every position is off by `amount`, metres
  kRunaway,         // the told position runs away at `amount`, metres per second
  kSlow,            // commands arrive `amount` seconds late
  kRejects,         // every command is rejected
  kNoAnswer,        // commands act, the acknowledgement stands still
  kWithheldAnswer,  // the acknowledgement is the one of `amount` commands ago
  kNotEnabled,      // the amplifiers stay off, and it says so
  kNoForce,         // the amplifiers give nothing, and it says so
  kOtherForce,      // the amplifiers give `amount` times the force, and it says so
  kForeignForce,    // it tells `amount` newtons in the place of the force
  kWrongSign,       // the amplifiers push the other way, and it tells the commanded force
  kNoPush,          // the amplifiers give nothing, and it tells the commanded force
  kClockRate,       // its clock runs at `amount` times the rate
  kClockJump,       // its clock is ahead by `amount`, seconds
  kNoise,           // every position is off by up to `amount`, metres
};
inline constexpr std::size_t kFaultKinds = static_cast<std::size_t>(FaultKind::kNoise) + 1;

// Amount of a lie if a script does not give it.
[[nodiscard]] constexpr double usual_amount(FaultKind kind) {
  switch (kind) {
    case FaultKind::kJump:
      return 1.0;
    case FaultKind::kRunaway:
      return 20.0;
    case FaultKind::kSlow:
      return 0.05;
    case FaultKind::kWithheldAnswer:
      return 30.0;
    case FaultKind::kOtherForce:
      return 0.5;
    case FaultKind::kForeignForce:
      return 3.0;
    case FaultKind::kClockRate:
      return 0.1;
    case FaultKind::kClockJump:
      return 0.05;
    case FaultKind::kNoise:
      return 1e-3;
    default:
      return 0.0;
  }
}

// Lasts `duration_us` from `begin_us`; corrupts the report of every `every`-th tick.
struct Fault {
  FaultKind kind = FaultKind::kSilent;
  std::uint64_t begin_us = 0;
  std::uint64_t duration_us = 0;
  std::uint32_t every = 1;
  std::optional<double> amount = std::nullopt;  // of a lie; nullopt: the usual one

  [[nodiscard]] bool lasts_at(std::uint64_t now_us) const {
    return now_us >= begin_us && now_us - begin_us < duration_us;
  }
};

class FaultScript {
 public:
  FaultScript() = default;
  FaultScript(std::initializer_list<Fault> faults) : faults_(faults) {}
  explicit FaultScript(std::vector<Fault> faults) : faults_(std::move(faults)) {}

  // Realtime-safe: yes, all.
  [[nodiscard]] bool lasts(FaultKind kind, std::uint64_t now_us) const {
    return std::ranges::any_of(
        faults_, [&](const Fault& fault) { return fault.kind == kind && fault.lasts_at(now_us); });
  }
  // The amount of the first such fault that lasts; nullopt without one.
  [[nodiscard]] std::optional<double> amount(FaultKind kind, std::uint64_t now_us) const {
    for (const Fault& fault : faults_) {
      if (fault.kind == kind && fault.lasts_at(now_us)) {
        return fault.amount.value_or(usual_amount(kind));
      }
    }
    return std::nullopt;
  }
  // Microseconds since the first such fault that lasts began; 0 without one.
  [[nodiscard]] std::uint64_t since_us(FaultKind kind, std::uint64_t now_us) const {
    for (const Fault& fault : faults_) {
      if (fault.kind == kind && fault.lasts_at(now_us)) return now_us - fault.begin_us;
    }
    return 0;
  }
  // Like lasts(), for faults that strike every `every`-th tick.
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
