// Quantiles of times, and a histogram with logarithmic bins: constant memory, one writing thread,
// any reading thread, no lock.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapticwall::session {

// Quantiles of a series of times, nanoseconds; all 0 for an empty series.
struct Quantiles {
  std::size_t count = 0;
  std::int64_t median_ns = 0;
  std::int64_t p99_ns = 0;
  std::int64_t p999_ns = 0;
  std::int64_t maximum_ns = 0;
};

// The nearest rank, from 1: the smallest of `count` (at least 1) sorted values that at least
// `share` (above 0, at most 1) of them do not exceed. Realtime-safe: yes.
[[nodiscard]] inline std::uint64_t nearest_rank(double share, std::uint64_t count) {
  const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count)));
  return rank < 1 ? 1 : rank;
}

// Calls `at(rank)` with ascending ranks. Precondition: count is not 0.
template <typename At>
[[nodiscard]] Quantiles quantiles_of(std::uint64_t count, At&& at) {
  constexpr double kMedian = 0.5;
  constexpr double kP99 = 0.99;
  constexpr double kP999 = 0.999;
  return {static_cast<std::size_t>(count), at(nearest_rank(kMedian, count)),
          at(nearest_rank(kP99, count)), at(nearest_rank(kP999, count)), at(count)};
}

// Exact, of all values. Realtime-safe: no.
[[nodiscard]] Quantiles quantiles(std::vector<std::int64_t> values_ns);

// One bin a nanosecond below 16 ns, then 16 bins an octave: the middle of a bin is within 1 part
// in 32. Realtime-safe: yes, every member.
class LatencyBins {
 public:
  static constexpr std::size_t kAnOctave = 16;
  // The bins reach to 2^36 ns, about a minute; longer times count in the last bin.
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

// A histogram at one moment. Trivially copyable.
struct LatencyCounts {
  std::array<std::uint64_t, LatencyBins::kCount> bins{};
  std::int64_t maximum_ns = 0;

  [[nodiscard]] std::uint64_t total() const;
  LatencyCounts& operator+=(const LatencyCounts& more);
  // The times added since `earlier`, an earlier moment of the same histogram. Its maximum is within
  // a bin, 1 part in 16.
  [[nodiscard]] LatencyCounts since(const LatencyCounts& earlier) const;
};

// Within 1 part in 32; the maximum is that of the counts. All 0 without counts.
[[nodiscard]] Quantiles quantiles(const LatencyCounts& counts);

class LatencyHistogram {
 public:
  // One thread only, so that an increment needs no locked instruction. Realtime-safe: yes.
  void add(std::int64_t time_ns) noexcept {
    if (time_ns > maximum_ns_.load(std::memory_order_relaxed)) {
      maximum_ns_.store(time_ns, std::memory_order_relaxed);
    }
    std::atomic<std::uint64_t>& bin = bins_[LatencyBins::of(time_ns)];
    bin.store(bin.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  // Any thread; bins written meanwhile may lag by one count. Realtime-safe: yes.
  void read(LatencyCounts& counts) const noexcept;

 private:
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
  static_assert(std::atomic<std::int64_t>::is_always_lock_free);

  std::array<std::atomic<std::uint64_t>, LatencyBins::kCount> bins_{};
  std::atomic<std::int64_t> maximum_ns_{0};
};

}  // namespace hapticwall::session
