// The link to a real device: which device a session is for, and the values that the loop and the
// link's three threads exchange without a mutex, an allocation or a wait.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/dialect.h"
#include "core/tick/triple_buffer.h"
#include "device/device.h"
#include "device/link/report.h"
#include "device/link_stats.h"
#include "device/os_threads.h"

namespace hapticwall::device {

inline constexpr std::int64_t kMillisecondNs = 1'000'000;

// One axis in a device file. It overrides what the device reports, except that the smaller force
// limit holds. An encoder or a force limit of 0 leaves the number to the device.
// `encoder_m` is in metres per count.
struct AxisDescription {
  double encoder_m = 0.0;
  double force_limit_n = 0.0;
  MotionLimits motion{};                // known from a device file only
  double max_force_rate_n_per_s = 0.0;  // of a device file; 0: the default, see describe()

  friend bool operator==(const AxisDescription&, const AxisDescription&) = default;
};

// One value for each axis; 0 for an axis that the device lacks.
using AxisValues = std::array<double, hid::kMaxAxes>;

struct ImpulseEngineOptions {
  std::string kind = "haptic device";  // in messages
  std::string path;                    // of a listing; empty: the first device that fits
  // Vendor 0: any device with the protocol's usage page or its test numbers.
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string serial;  // empty: any
  std::string name;    // of the device file; empty: the device's own name
  std::array<std::optional<AxisDescription>, hid::kMaxAxes> axes;  // of the device file
  std::optional<Dialect> dialect;  // of the device file; nullopt: it speaks docs/hid-protocol.md
  double rate_hz = 1000.0;         // of a dialect's reports, by the device file
  // The newest command is repeated after so long without another, and removes the force once it is
  // too old; 0: the device has a time to live.
  std::int64_t keep_alive_ns = 0;
  bool delay_is_known = true;   // false: the device itself acknowledges no command
  bool has_clock = true;        // false: the times of its states are those of their arrival
  bool reads_may_hang = false;  // a read that does not return is a silent device
  // False: it tells positions only. `states` then counts changes of position, and its delay is one
  // that was measured in another session, on this date; 0: unknown.
  bool acknowledges = true;
  double delay_s = 0.0;
  std::string delay_date;
  // Advice while an open device has sent no state, which may take any time; empty: it must send one
  // within kFirstStateNs.
  std::string first_state_advice;
  // Assumed position of the handle at link-up, metres. A calibrated device reports its own.
  AxisValues start_m{};
  // Runs first on the threads that read and write, for example to set their priority.
  std::function<void()> prepare_thread;
};

// The link is lost after this time without a valid report.
inline constexpr std::int64_t kLinkLostNs = 20'000'000;
// Twice a reader's wait for a report: a longer pause between two reads means that it was held up.
inline constexpr std::int64_t kMaxDeafNs = 10'000'000;

// Recent reads and reports of the reader: why a link fell silent. All times are the host's, in
// nanoseconds. Realtime-safe: yes, all of it.
class Listening {
 public:
  // Call it before the link begins, with ImpulseEngineOptions::reads_may_hang.
  void let_reads_hang(bool may_hang) { reads_may_hang_ = may_hang; }
  // Reader: a link begins.
  void begin(std::int64_t now_ns) {
    heard(now_ns, false);
    since_ns_ = now_ns;
    void_ns_ = now_ns - kLinkLostNs;
  }
  // Reader: a read returned.
  void heard(std::int64_t now_ns, bool failed) {
    if (was_deaf(now_ns)) since_ns_ = now_ns;
    listened_ns_ = now_ns;
    failed_ = failed;
  }
  // Reader: it brought a void report.
  void heard_void(std::int64_t now_ns) { void_ns_ = now_ns; }

  // Why no valid state came for kLinkLostNs. Any thread.
  [[nodiscard]] Trouble cause(std::int64_t now_ns) const {
    if (failed_) return Trouble::kUnplugged;
    const bool held_up = was_deaf(now_ns) || now_ns - since_ns_ <= kLinkLostNs;
    if (held_up && !reads_may_hang_) return Trouble::kHeldUp;
    return now_ns - void_ns_ <= kMaxDeafNs ? Trouble::kVoid : Trouble::kSilent;
  }

 private:
  [[nodiscard]] bool was_deaf(std::int64_t now_ns) const {
    return now_ns - listened_ns_ > kMaxDeafNs;
  }

  std::atomic<std::int64_t> listened_ns_{0};  // the newest read
  std::atomic<std::int64_t> since_ns_{0};     // since when without a pause
  std::atomic<std::int64_t> void_ns_{0};      // the newest void report
  std::atomic<bool> failed_{false};           // the newest read
  bool reads_may_hang_ = false;
};

// Nanoseconds since a fixed instant; monotonic. Realtime-safe: yes.
using HostClock = std::function<std::int64_t()>;

// Reader to loop: the newest state. Trivially copyable.
struct LinkView {
  std::uint32_t session = 0;         // 0: no valid state yet
  Trouble trouble = Trouble::kNone;  // that the device shows; see StateTracker::ended()
  std::int64_t received_ns = 0;      // the newest valid state, by the host's clock
  std::int64_t device_time_us = 0;   // its latch by the device's clock, unwrapped
  std::uint32_t latch_us = 0;        // this latch as received
  std::uint16_t sequence = 0;
  AxisValues position_m{};
  AxisValues applied_n{};  // told by the device; positive pushes out of the wall
  AxisValues limit_n{};
  LinkStats stats;  // without the parts that the loop, the writer and the owner count
};

// Loop to writer: the newest command. Trivially copyable.
struct LinkCommand {
  std::uint32_t session = 0;  // of the link for which it was made
  std::int64_t made_ns = 0;   // read time of the position that it was computed from
  bool enable = false;
  bool clear_faults = false;  // never with enable
  AxisValues force_n{};       // positive pushes out of the wall, to smaller positions
  AxisValues limit_n{};       // of the device; every force is clamped to it
  // The state that it was computed from.
  std::uint16_t state_sequence = 0;
  std::uint32_t state_latch_us = 0;
};

// Owner to loop: the open session (0: none), and why none is open or the previous one ended. Loop
// to owner: the session that it lost, and why.
struct LinkStatus {
  std::uint32_t session = 0;
  Trouble reason = Trouble::kNotFound;
};
static_assert(std::atomic<LinkStatus>::is_always_lock_free);

// The values that the threads of a link share. Each member has one writing thread.
struct LinkExchange {
  TripleBuffer<LinkView> views;        // reader -> loop
  TripleBuffer<LinkCommand> commands;  // loop -> writer
  WakeSignal command_signal;

  std::atomic<LinkStatus> status{LinkStatus{}};  // owner -> loop
  std::atomic<LinkStatus> lost{LinkStatus{}};    // loop -> owner
  Listening listening;                           // reader -> loop, owner
  std::atomic<std::int64_t> write_ns{0};         // writer -> loop: duration of the newest write
  std::atomic<std::int64_t> longest_write_ns{0};
  std::atomic<std::uint64_t> losses{0};  // owner -> loop
};

}  // namespace hapticwall::device
