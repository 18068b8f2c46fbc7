// A histogram that is read while it is written; clean under ThreadSanitizer.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <thread>

#include "app/session/loop/latency_histogram.h"

namespace hapticwall::session {
namespace {

constexpr std::int64_t kTimes = 300'000;

// Up and down over all sizes; the maximum rises all the time.
std::int64_t time_of(std::int64_t index) { return index % 3 == 0 ? index * 1000 : index % 1000; }

std::size_t highest_bin(const LatencyCounts& counts) {
  std::size_t highest = 0;
  for (std::size_t bin = 0; bin < counts.bins.size(); ++bin) {
    if (counts.bins[bin] > 0) highest = bin;
  }
  return highest;
}

TEST(LatencyHistogramStress, AReaderSeesCountsGrowAndNoneTwice) {
  LatencyHistogram histogram;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::int64_t i = 0; i < kTimes; ++i) histogram.add(time_of(i));
    done.store(true, std::memory_order_release);
  });
  LatencyCounts previous;
  LatencyCounts counts;
  std::uint64_t wrong = 0;
  bool last = false;
  while (!last) {
    last = done.load(std::memory_order_acquire);
    histogram.read(counts);
    const LatencyCounts newer = counts.since(previous);
    wrong += newer.total() + previous.total() == counts.total() ? 0U : 1U;
    wrong += newer.total() <= static_cast<std::uint64_t>(kTimes) ? 0U : 1U;
    wrong += highest_bin(counts) <= LatencyBins::of(counts.maximum_ns) ? 0U : 1U;
    previous = counts;
  }
  writer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(counts.total(), static_cast<std::uint64_t>(kTimes));
  EXPECT_EQ(counts.maximum_ns, time_of(kTimes - 3));
}

}  // namespace
}  // namespace hapticwall::session
