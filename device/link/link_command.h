// Turns a command into a FORCE report: the last check of a force before it leaves the host. No I/O
// and no clock. Realtime-safe: yes, all of it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "device/link/link.h"
#include "device/link/report.h"

namespace hapticwall::device {

// Clamps the forces to the limit. The report enables no force if the command does not, if a force
// is not finite, or if the position is older than kLinkLostNs.
[[nodiscard]] hid::ForceReport force_report(const LinkCommand& command, std::uint16_t sequence,
                                            std::int64_t now_ns);

// The force of a command that was sent, in the millinewtons of a report.
struct SentForce {
  bool enable = false;
  std::array<std::int16_t, hid::kMaxAxes> force_mn{};

  friend bool operator==(const SentForce&, const SentForce&) = default;
};
[[nodiscard]] SentForce sent_force(const hid::ForceReport& report);

// Maps the newest commands of a session to the states that they were computed from, for the
// measurement of the delay, and to their forces. The writer notes, the reader asks.
class SentCommands {
 public:
  // Notes a command before it goes out. One thread.
  void note(std::uint16_t sequence, std::uint32_t state_latch_us, const SentForce& force = {});
  // Latch time of the state behind this command, by the device's clock; nullopt if this session has
  // not sent it among its newest kKept. Any thread.
  [[nodiscard]] std::optional<std::uint32_t> latch_us(std::uint16_t sequence) const;
  // Its force, under the same conditions. Any thread.
  [[nodiscard]] std::optional<SentForce> force(std::uint16_t sequence) const;

 private:
  static constexpr std::size_t kKept = 256;
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

  // Bits from the lowest: latch time, sequence, present.
  std::array<std::atomic<std::uint64_t>, kKept> slots_{};
  // Bits from the lowest: force of each axis, sequence, present, enable.
  std::array<std::atomic<std::uint64_t>, kKept> forces_{};
};

}  // namespace hapticwall::device
