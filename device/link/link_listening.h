// Recent reads and reports of the reader: why a link fell silent. Realtime-safe: yes, all of it.
#pragma once

#include <atomic>
#include <cstdint>

#include "device/link_stats.h"

namespace hapticwall::device {

// The link is lost after this time without a valid report.
inline constexpr std::int64_t kLinkLostNs = 20'000'000;
// Twice a reader's wait for a report: a longer pause between two reads means that it was held up.
inline constexpr std::int64_t kMaxDeafNs = 10'000'000;

// All times are the host's, in nanoseconds.
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

}  // namespace hapticwall::device
