// From input packets to the state of the link: decoding, judging, counting, measuring. What the
// reader's thread does with what it has read; no I/O, no clock of its own.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "device/hid_description.h"
#include "device/hid_report.h"
#include "device/link_command.h"
#include "device/link_figures.h"
#include "device/link_options.h"

namespace hapticwall::device {

// The newest state of a link and what led to it. Trivially copyable.
struct LinkView {
  std::uint32_t session = 0;         // 0: no valid state yet, ever
  Trouble trouble = Trouble::kNone;  // that the device shows; see StateTracker::ended()
  std::int64_t received_ns = 0;      // the newest valid state, by the host's clock
  std::int64_t device_time_us = 0;   // its latch, by the device's clock, without the wraps
  std::uint32_t latch_us = 0;        // the same as the device said it
  std::uint16_t sequence = 0;
  AxisValues position_m{};
  AxisValues limit_n{};
  LinkFigures figures;  // all but what only the loop's, the writer's and the owner's side know
};

// What does not change while a link is up.
struct LinkSession {
  std::uint32_t number = 0;  // from 1
  hid::DeviceFigures device;
  AxisValues start_m{};  // where an uncalibrated handle is at the first state
  std::shared_ptr<const SentCommands> sent;
};

// Realtime-safe: yes, but for begin().
class StateTracker {
 public:
  // A new link; counters and maxima go on.
  void begin(const LinkSession& session);

  // One input packet, any bytes, and when it came (host's clock, never going back). True where it
  // was a valid new state.
  bool take(std::span<const std::uint8_t> bytes, std::int64_t received_ns);

  // What the link shows. That of the link before until the first valid state, but for the counters.
  [[nodiscard]] const LinkView& view() const { return view_; }
  // Why nothing more of this link will be taken: it has to be brought up anew. Else kNone.
  [[nodiscard]] Trouble ended() const { return ended_; }

 private:
  [[nodiscard]] Trouble objection(const hid::StateReport& state, std::int64_t received_ns) const;
  void begin_with(const hid::StateReport& state);
  void follow(const hid::StateReport& state);
  void accept(const hid::StateReport& state, std::int64_t received_ns);
  void measure(const hid::StateReport& state, bool next_tick);

  LinkSession session_;
  LinkView view_;
  Trouble ended_ = Trouble::kNone;
  std::optional<hid::StateReport> newest_;                    // of this link
  std::array<std::int32_t, hid::kMostAxes> origin_counts_{};  // at which the handle is at
  AxisValues origin_m_{};                                     // this place
  std::int64_t first_time_us_ = 0;
  std::uint64_t ticks_ = 0;  // of the device since the first state
};

// The fault that a state tells of; kNone where it tells of none. Realtime-safe: yes.
[[nodiscard]] Trouble fault_in(const hid::StateReport& state);

}  // namespace hapticwall::device
