// Median and maximum of a tick's cost over the last second, in constant memory.
//
// Keeps a histogram and a maximum for each of four quarters of a second. At the end of a quarter it
// drops the oldest and updates the statistics. The median is within 1 part in 32.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "app/session/loop/latency_histogram.h"

namespace hapticwall::session {

struct CostStats {
  std::int64_t median_ns = 0;
  std::int64_t maximum_ns = 0;
  std::uint32_t ticks = 0;  // 0: unknown
};

// Realtime-safe: yes. The end of a quarter costs a pass over the bins, about a microsecond.
class CostWindow {
 public:
  static constexpr std::int64_t kQuarterNs = 250'000'000;
  static constexpr std::size_t kQuarters = 4;

  // A tick that began at `now_ns`, not before the previous one, took `cost_ns`.
  void add(std::int64_t now_ns, std::int64_t cost_ns) {
    if (!started_) {
      started_ = true;
      quarter_end_ns_ = now_ns + kQuarterNs;
    }
    if (now_ns >= quarter_end_ns_) turn_over(now_ns);
    Quarter& quarter = quarters_[current_];
    const std::int64_t cost = std::max<std::int64_t>(cost_ns, 0);
    ++quarter.bins[LatencyBins::of(cost)];
    ++quarter.ticks;
    quarter.maximum_ns = std::max(quarter.maximum_ns, cost);
  }

  // Over the second before the end of the last quarter.
  [[nodiscard]] const CostStats& stats() const { return stats_; }

 private:
  struct Quarter {
    std::array<std::uint32_t, LatencyBins::kCount> bins{};
    std::uint32_t ticks = 0;
    std::int64_t maximum_ns = 0;
  };

  void turn_over(std::int64_t now_ns) {
    update();
    // A pause of a second or more clears all quarters.
    for (std::size_t turned = 0; turned < kQuarters && now_ns >= quarter_end_ns_; ++turned) {
      quarter_end_ns_ += kQuarterNs;
      current_ = (current_ + 1) % kQuarters;
      quarters_[current_] = Quarter{};
    }
    if (now_ns >= quarter_end_ns_) quarter_end_ns_ = now_ns + kQuarterNs;
  }

  void update() {
    CostStats stats;
    for (const Quarter& quarter : quarters_) {
      stats.ticks += quarter.ticks;
      stats.maximum_ns = std::max(stats.maximum_ns, quarter.maximum_ns);
    }
    std::uint32_t below = 0;
    for (std::size_t bin = 0; bin < LatencyBins::kCount; ++bin) {
      for (const Quarter& quarter : quarters_) below += quarter.bins[bin];
      if (2 * static_cast<std::uint64_t>(below) >= stats.ticks) {
        stats.median_ns = LatencyBins::middle_ns(bin);
        break;
      }
    }
    stats_ = stats;
  }

  std::array<Quarter, kQuarters> quarters_{};
  std::size_t current_ = 0;
  std::int64_t quarter_end_ns_ = 0;
  bool started_ = false;
  CostStats stats_;
};

}  // namespace hapticwall::session
