// How often which time was met, in constant memory: a histogram with logarithmic bins, written by
// one thread and read by another, without a lock.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "app/runtime/quantiles.h"

namespace hapticwall::runtime {

// Below 16 ns one bin a nanosecond, then 16 to a power of two: the middle of a bin is right to 1
// part in 32. Realtime-safe: yes, every member.
class LatencyBins {
 public:
  static constexpr std::size_t kAnOctave = 16;
  // Up to 2^36 ns, which is a minute; what is longer counts as that.
  static constexpr std::size_t kCount = std::size_t{33} * kAnOctave;

  // Times below 0 count as 0.
  [[nodiscard]] static std::size_t of(std::int64_t time_ns) {
    const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(time_ns, 0));
    const int shift = std::max(0, static_cast<int>(std::bit_width(time)) - kMantissaBits - 1);
    const std::size_t bin = static_cast<std::size_t>(shift) * kAnOctave +
                            static_cast<std::size_t>(time >> static_cast<unsigned>(shift));
    return std::min(bin, kCount - 1);
  }
  // The smallest time of a bin, up to kCount.
  [[nodiscard]] static std::int64_t from_ns(std::size_t bin) {
    if (bin < 2 * kAnOctave) return static_cast<std::int64_t>(bin);
    const std::size_t shift = bin / kAnOctave - 1;
    return static_cast<std::int64_t>((bin - shift * kAnOctave) << shift);
  }
  [[nodiscard]] static std::int64_t middle_ns(std::size_t bin) {
    return (from_ns(bin) + from_ns(bin + 1)) / 2;
  }

 private:
  static constexpr int kMantissaBits = 4;
  static_assert(std::size_t{1} << kMantissaBits == kAnOctave);
};

// A histogram as it was at one moment. Trivially copyable.
struct LatencyCounts {
  std::array<std::uint64_t, LatencyBins::kCount> bins{};
  std::int64_t maximum_ns = 0;

  [[nodiscard]] std::uint64_t total() const;
  LatencyCounts& operator+=(const LatencyCounts& more);
  // What has come since `earlier`, an earlier moment of the same histogram. Its maximum is right to
  // a bin, 1 part in 16.
  [[nodiscard]] LatencyCounts since(const LatencyCounts& earlier) const;
};

// Within 1 part in 32, the maximum exact where the counts' own is; all 0 where nothing was counted.
[[nodiscard]] Quantiles quantiles(const LatencyCounts& counts);

class LatencyHistogram {
 public:
  // By one thread only: no other writes, so an increment needs no locked instruction.
  // Realtime-safe: yes.
  void add(std::int64_t time_ns) noexcept {
    if (time_ns > maximum_ns_.load(std::memory_order_relaxed)) {
      maximum_ns_.store(time_ns, std::memory_order_relaxed);
    }
    std::atomic<std::uint64_t>& bin = bins_[LatencyBins::of(time_ns)];
    bin.store(bin.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  // From any thread; bins that are written meanwhile may be a count behind. Realtime-safe: yes.
  void read(LatencyCounts& counts) const noexcept;

 private:
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
  static_assert(std::atomic<std::int64_t>::is_always_lock_free);

  std::array<std::atomic<std::uint64_t>, LatencyBins::kCount> bins_{};
  std::atomic<std::int64_t> maximum_ns_{0};
};

}  // namespace hapticwall::runtime
