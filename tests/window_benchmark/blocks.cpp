#include "tests/window_benchmark/blocks.h"

#include <algorithm>
#include <cstdio>

#include "core/units.h"

namespace hapticwall::window_benchmark {

void print_heading() {
  std::printf("\n%-26s %10s %9s %9s %9s %9s %8s\n", "us", "cycles", "median", "p99", "p99.9",
              "most", "missed");
}

void print_row(const Blocks& blocks, const char* what, const session::LatencyCounts& counts) {
  const session::Quantiles row = session::quantiles(counts);
  const auto us = [](std::int64_t time_ns) {
    return static_cast<double>(time_ns) / kNanosecondsPerMicrosecond;
  };
  std::printf("%-16s%-10s %10zu %9.1f %9.1f %9.1f %9.1f %8llu\n", blocks.name, what, row.count,
              us(row.median_ns), us(row.p99_ns), us(row.p999_ns), us(row.maximum_ns),
              static_cast<unsigned long long>(blocks.missed_ticks));
}

std::int64_t p99_at(const Blocks& blocks, std::size_t quarters) {
  std::vector<std::int64_t> sorted = blocks.p99_ns;
  std::sort(sorted.begin(), sorted.end());
  return sorted[quarters * (sorted.size() - 1) / 4];
}

void print_spread(const Blocks& blocks) {
  const auto at = [&](std::size_t quarters) {
    return static_cast<double>(p99_at(blocks, quarters)) / kNanosecondsPerMicrosecond;
  };
  std::printf(
      "%-16sp99 of each of %zu blocks: %.1f to %.1f, quartiles %.1f %.1f %.1f us; %.1f s stolen by "
      "the host\n",
      blocks.name, blocks.p99_ns.size(), at(0), at(4), at(1), at(2), at(3), blocks.stolen_s);
}

double ratio(std::int64_t with_ns, std::int64_t without_ns) {
  return static_cast<double>(with_ns) / static_cast<double>(without_ns);
}

}  // namespace hapticwall::window_benchmark
