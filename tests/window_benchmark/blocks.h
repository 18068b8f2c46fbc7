// Blocks of time that take turns: what the machine does besides hits all kinds alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/session/loop/snapshot.h"

namespace hapticwall::window_benchmark {

// All blocks of a kind.
struct Blocks {
  const char* name;
  session::TimingHistograms timing;
  std::uint64_t missed_ticks = 0;
  std::uint64_t frames = 0;
  double seconds = 0.0;
  double stolen_s = 0.0;
  std::vector<std::int64_t> p99_ns;  // of the wake-ups of each block
};

// One for each kind, under the heading.
void print_heading();
void print_row(const Blocks& blocks, const char* what, const session::LatencyCounts& counts);
// How far the rest of the machine, and its host, make one block differ from the other.
void print_spread(const Blocks& blocks);

// The p99 of the blocks at so many quarters of them, in order: 2 is the median.
[[nodiscard]] std::int64_t p99_at(const Blocks& blocks, std::size_t quarters);
[[nodiscard]] double ratio(std::int64_t with_ns, std::int64_t without_ns);

}  // namespace hapticwall::window_benchmark
