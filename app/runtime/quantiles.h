// What is said of many times: median, the rare late ones, the worst.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapticwall::runtime {

// Of a series of times, nanoseconds; all 0 where there are none.
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

// Calls `at(rank)` for the ranks that are told. Precondition: count is not 0.
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

}  // namespace hapticwall::runtime
