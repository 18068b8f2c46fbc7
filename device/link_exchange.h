// Everything that passes between the loop's side of a link and its threads: no mutex, no
// allocation, and no side that waits for the other.
#pragma once

#include <atomic>
#include <cstdint>

#include "device/link_command.h"
#include "device/link_figures.h"
#include "device/link_state.h"
#include "device/os_threads.h"
#include "device/triple_buffer.h"

namespace hapticwall::device {

// What the owner tells the loop.
struct LinkStatus {
  std::uint32_t session = 0;            // that is open; 0: none
  Trouble reason = Trouble::kNotFound;  // why there is none, or why the one before ended
};

struct LinkExchange {
  TripleBuffer<LinkView> views;        // reader -> loop
  TripleBuffer<LinkCommand> commands;  // loop -> writer
  WakeSignal command_signal;

  void show(LinkStatus status) {
    status_.store((std::uint64_t{status.session} << kSessionShift) |
                      static_cast<std::uint64_t>(status.reason),
                  std::memory_order_release);
  }
  // Realtime-safe: yes.
  [[nodiscard]] LinkStatus status() const {
    const std::uint64_t packed = status_.load(std::memory_order_acquire);
    return {static_cast<std::uint32_t>(packed >> kSessionShift),
            static_cast<Trouble>(packed & kReasonMask)};
  }

  std::atomic<std::uint32_t> lost_session{0};  // loop -> owner: one that was silent for too long
  std::atomic<std::int64_t> write_ns{0};       // writer -> loop: what the newest write took
  std::atomic<std::int64_t> longest_write_ns{0};
  std::atomic<std::uint64_t> losses{0};  // owner -> loop

 private:
  static constexpr unsigned kSessionShift = 32;
  static constexpr std::uint64_t kReasonMask = 0xFF;

  std::atomic<std::uint64_t> status_{static_cast<std::uint64_t>(Trouble::kNotFound)};
};

}  // namespace hapticwall::device
