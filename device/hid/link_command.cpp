#include "device/hid/link_command.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::device {
namespace {

constexpr std::uint64_t kPresentBit = std::uint64_t{1} << 48U;
constexpr unsigned kSequenceShift = 32;

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

void SentCommands::note(std::uint16_t sequence, std::uint32_t state_latch_us) {
  const std::uint64_t packed =
      kPresentBit | (std::uint64_t{sequence} << kSequenceShift) | state_latch_us;
  slots_[sequence % kKept].store(packed, std::memory_order_release);
}

std::optional<std::uint32_t> SentCommands::latch_us(std::uint16_t sequence) const {
  const std::uint64_t packed = slots_[sequence % kKept].load(std::memory_order_acquire);
  const std::uint64_t wanted = kPresentBit | (std::uint64_t{sequence} << kSequenceShift);
  if ((packed >> kSequenceShift) != (wanted >> kSequenceShift)) return std::nullopt;
  return static_cast<std::uint32_t>(packed);
}

}  // namespace hapticwall::device
