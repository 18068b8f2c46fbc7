#include "app/session/loop/latency_histogram.h"

#include <numeric>

namespace hapticwall::session {

Quantiles quantiles(std::vector<std::int64_t> values_ns) {
  if (values_ns.empty()) return {};
  std::sort(values_ns.begin(), values_ns.end());
  return quantiles_of(values_ns.size(), [&](std::uint64_t rank) { return values_ns[rank - 1]; });
}

std::uint64_t LatencyCounts::total() const {
  return std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
}

LatencyCounts& LatencyCounts::operator+=(const LatencyCounts& more) {
  for (std::size_t bin = 0; bin < bins.size(); ++bin) bins[bin] += more.bins[bin];
  maximum_ns = std::max(maximum_ns, more.maximum_ns);
  return *this;
}

LatencyCounts LatencyCounts::since(const LatencyCounts& earlier) const {
  LatencyCounts newer;
  std::size_t highest = 0;
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    newer.bins[bin] = bins[bin] - earlier.bins[bin];
    if (newer.bins[bin] > 0) highest = bin;
  }
  const bool of_now = highest == LatencyBins::of(maximum_ns);
  newer.maximum_ns = of_now ? maximum_ns : LatencyBins::middle_ns(highest);
  return newer;
}

Quantiles quantiles(const LatencyCounts& counts) {
  const std::uint64_t total = counts.total();
  if (total == 0) return {};
  std::size_t bin = 0;
  std::uint64_t up_to = counts.bins[0];
  Quantiles result = quantiles_of(total, [&](std::uint64_t rank) {
    while (up_to < rank) up_to += counts.bins[++bin];
    return std::min(LatencyBins::middle_ns(bin), counts.maximum_ns);
  });
  result.maximum_ns = counts.maximum_ns;
  return result;
}

void LatencyHistogram::read(LatencyCounts& counts) const noexcept {
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    counts.bins[bin] = bins_[bin].load(std::memory_order_acquire);
  }
  // Written before its bin and read after it: never below the highest bin.
  counts.maximum_ns = maximum_ns_.load(std::memory_order_relaxed);
}

}  // namespace hapticwall::session
