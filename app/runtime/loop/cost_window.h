// What a tick has cost in the last second: median and maximum, in constant memory.
//
// Four quarters of a second, each with a histogram and a maximum of its own; when a quarter is over
// the oldest is forgotten and the figures are told anew. The bins are those of latency_histogram.h,
// so the median is right to 1 part in 32.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "app/runtime/latency_histogram.h"

namespace hapticwall::runtime {

struct CostFigures {
  std::int64_t median_ns = 0;
  std::int64_t maximum_ns = 0;
  std::uint32_t ticks = 0;  // 0: nothing is known yet
};

// Realtime-safe: yes. A quarter's end costs a pass over the bins, about a microsecond.
class CostWindow {
 public:
  static constexpr std::int64_t kQuarterNs = 250'000'000;
  static constexpr std::size_t kQuarters = 4;

  // A tick that began at `now_ns` (not before the last one) took `cost_ns`.
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

  // Of the last second, as of the last quarter's end.
  [[nodiscard]] const CostFigures& figures() const { return figures_; }

 private:
  struct Quarter {
    std::array<std::uint32_t, LatencyBins::kCount> bins{};
    std::uint32_t ticks = 0;
    std::int64_t maximum_ns = 0;
  };

  void turn_over(std::int64_t now_ns) {
    tell();
    // After a pause of a second or more nothing of what was before is in the last second.
    for (std::size_t turned = 0; turned < kQuarters && now_ns >= quarter_end_ns_; ++turned) {
      quarter_end_ns_ += kQuarterNs;
      current_ = (current_ + 1) % kQuarters;
      quarters_[current_] = Quarter{};
    }
    if (now_ns >= quarter_end_ns_) quarter_end_ns_ = now_ns + kQuarterNs;
  }

  void tell() {
    CostFigures figures;
    for (const Quarter& quarter : quarters_) {
      figures.ticks += quarter.ticks;
      figures.maximum_ns = std::max(figures.maximum_ns, quarter.maximum_ns);
    }
    std::uint32_t below = 0;
    for (std::size_t bin = 0; bin < LatencyBins::kCount; ++bin) {
      for (const Quarter& quarter : quarters_) below += quarter.bins[bin];
      if (2 * static_cast<std::uint64_t>(below) >= figures.ticks) {
        figures.median_ns = LatencyBins::middle_ns(bin);
        break;
      }
    }
    figures_ = figures;
  }

  std::array<Quarter, kQuarters> quarters_{};
  std::size_t current_ = 0;
  std::int64_t quarter_end_ns_ = 0;
  bool started_ = false;
  CostFigures figures_;
};

}  // namespace hapticwall::runtime
