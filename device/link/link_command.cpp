#include "device/link/link_command.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::device {
namespace {

constexpr std::uint64_t kPresentBit = std::uint64_t{1} << 48U;
constexpr std::uint64_t kEnableBit = kPresentBit << 1U;
constexpr unsigned kSequenceShift = 32;
constexpr unsigned kForceShift = 16;  // shift of the second axis

}  // namespace

hid::ForceReport force_report(const LinkCommand& command, std::uint16_t sequence,
                              std::int64_t now_ns) {
  hid::ForceReport report;
  report.sequence = sequence;
  report.echoed_state_sequence = command.state_sequence;
  report.enable =
      command.enable && !command.clear_faults && now_ns - command.made_ns <= kLinkLostNs;
  for (const double force_n : command.force_n) {
    report.enable = report.enable && std::isfinite(force_n);
  }
  report.clear_faults = command.clear_faults && !report.enable;
  if (!report.enable) return report;
  for (std::size_t axis = 0; axis < report.force_n.size(); ++axis) {
    const double max_n = std::max(0.0, command.limit_n[axis]);  // this order gives 0 for NaN
    // A positive force of a report pushes towards growing counts: into the wall.
    report.force_n[axis] = std::clamp(-command.force_n[axis], -max_n, max_n);
  }
  return report;
}

SentForce sent_force(const hid::ForceReport& report) {
  SentForce force;
  force.enable = report.enable;
  for (std::size_t axis = 0; axis < force.force_mn.size(); ++axis) {
    force.force_mn[axis] =
        static_cast<std::int16_t>(std::lround(report.force_n[axis] * hid::kStepsPerNewton));
  }
  return force;
}

// The latch last: who finds it finds the force, too.
void SentCommands::note(std::uint16_t sequence, std::uint32_t state_latch_us,
                        const SentForce& force) {
  const std::uint64_t tag = kPresentBit | (std::uint64_t{sequence} << kSequenceShift);
  const auto half = [&](std::size_t axis) {
    return std::uint64_t{static_cast<std::uint16_t>(force.force_mn[axis])};
  };
  forces_[sequence % kKept].store(
      tag | (force.enable ? kEnableBit : 0U) | (half(1) << kForceShift) | half(0),
      std::memory_order_release);
  slots_[sequence % kKept].store(tag | state_latch_us, std::memory_order_release);
}

std::optional<SentForce> SentCommands::force(std::uint16_t sequence) const {
  const std::uint64_t packed = forces_[sequence % kKept].load(std::memory_order_acquire);
  const std::uint64_t wanted = kPresentBit | (std::uint64_t{sequence} << kSequenceShift);
  if (((packed & ~kEnableBit) >> kSequenceShift) != (wanted >> kSequenceShift)) return std::nullopt;
  SentForce force;
  force.enable = (packed & kEnableBit) != 0;
  force.force_mn = {static_cast<std::int16_t>(static_cast<std::uint16_t>(packed)),
                    static_cast<std::int16_t>(static_cast<std::uint16_t>(packed >> kForceShift))};
  return force;
}

std::optional<std::uint32_t> SentCommands::latch_us(std::uint16_t sequence) const {
  const std::uint64_t packed = slots_[sequence % kKept].load(std::memory_order_acquire);
  const std::uint64_t wanted = kPresentBit | (std::uint64_t{sequence} << kSequenceShift);
  if ((packed >> kSequenceShift) != (wanted >> kSequenceShift)) return std::nullopt;
  return static_cast<std::uint32_t>(packed);
}

}  // namespace hapticwall::device
