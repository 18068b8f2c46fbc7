// Tracks the state of a link from its input packets, on the reader's thread: decodes, checks,
// counts and measures. No I/O and no clock.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "device/link/description.h"
#include "device/link/link.h"
#include "device/link/link_command.h"
#include "device/link/report.h"

namespace hapticwall::device {

// Constant while a link is up.
struct LinkSession {
  std::uint32_t number = 0;  // from 1
  hid::DeviceDescription device;
  AxisValues start_m{};  // position of an uncalibrated handle at the first state
  std::shared_ptr<const SentCommands> sent;
  bool delay_is_known = true;  // these as of ImpulseEngineOptions
  bool has_clock = true;
  bool acknowledges = true;
  double delay_s = 0.0;
};

// Realtime-safe: yes, except begin().
class StateTracker {
 public:
  // A new link; counters and maxima continue.
  void begin(const LinkSession& session);

  // Takes one input packet of any bytes, and its arrival by the host's monotonic clock. True if it
  // is a valid new state. `gap` ends the link if no valid state came for kLinkLostNs before.
  bool take(std::span<const std::uint8_t> bytes, std::int64_t received_ns,
            Trouble gap = Trouble::kSilent);

  // The view of the previous link, except for the counters, until the first valid state.
  [[nodiscard]] const LinkView& view() const { return view_; }
  // Why this link takes no more states and must be reopened; kNone while it does.
  [[nodiscard]] Trouble ended() const { return ended_; }

 private:
  [[nodiscard]] Trouble objection(const hid::StateReport& state) const;
  void begin_with(const hid::StateReport& state);
  void follow(const hid::StateReport& state);
  void accept(const hid::StateReport& state, std::int64_t received_ns);
  void measure(const hid::StateReport& state, bool next_tick);
  void hear_answer(const hid::StateReport& state, bool another);
  void count_answer(std::uint16_t sequence);
  [[nodiscard]] ForceWord force_word(const hid::StateReport& state) const;
  [[nodiscard]] std::optional<std::uint32_t> latch_behind(const hid::StateReport& state) const;

  LinkSession session_;
  LinkView view_;
  Trouble ended_ = Trouble::kNone;
  std::optional<hid::StateReport> newest_;                   // of this link
  std::array<std::int32_t, hid::kMaxAxes> origin_counts_{};  // counts at
  AxisValues origin_m_{};                                    // this position
  std::int64_t first_time_us_ = 0;
  std::uint64_t ticks_ = 0;  // of the device since the first state
  // Times by the device's clock, unwrapped: of the last state with another acknowledgement, and of
  // the latch behind the last command that was acknowledged.
  std::optional<std::uint16_t> answered_;  // number of the last acknowledged command of this link
  std::int64_t answered_us_ = 0;
  std::int64_t command_us_ = 0;
};

// The fault in a state, or kNone. Realtime-safe: yes.
[[nodiscard]] Trouble fault_in(const hid::StateReport& state);

}  // namespace hapticwall::device
