// From what the loop wants to a FORCE report: the last place that a force passes before it leaves
// the host. No I/O, no clock of its own. Realtime-safe: yes, all of it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "device/hid_report.h"
#include "device/link_options.h"

namespace hapticwall::device {

// No valid report for this long: the link is lost.
inline constexpr std::int64_t kLinkLostNs = 20'000'000;

// What the loop wants, for whichever report goes out next. Trivially copyable.
struct LinkCommand {
  std::uint32_t session = 0;  // of the link that it is for
  std::int64_t made_ns = 0;   // when the position was read that it was computed from
  bool enable = false;
  bool clear_faults = false;  // never with enable
  AxisValues force_n{};       // positive pushes out of the wall, to smaller positions
  AxisValues limit_n{};       // of the device; no force goes beyond it, whatever it is
  // The state that it was computed from.
  std::uint16_t state_sequence = 0;
  std::uint32_t state_latch_us = 0;
};

// The report of a command: without enable no force, within the limit, finite; without enable too
// where a force is not a number, or where the position is older than a link that is lost.
[[nodiscard]] hid::ForceReport force_report(const LinkCommand& command, std::uint16_t sequence,
                                            std::int64_t now_ns);

// Which state each command of a session went back to, from the writer to the reader: the newest
// few hundred of them.
class SentCommands {
 public:
  // Before the command goes out. One thread.
  void note(std::uint16_t sequence, std::uint32_t state_latch_us);
  // When the state was latched (device's clock) that led to this command; nothing where this
  // session has not sent it, or long ago. Any thread.
  [[nodiscard]] std::optional<std::uint32_t> latch_us(std::uint16_t sequence) const;

 private:
  static constexpr std::size_t kKept = 256;
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

  // Latch time, then the sequence, then a bit that says that there is one.
  std::array<std::atomic<std::uint64_t>, kKept> slots_{};
};

}  // namespace hapticwall::device
