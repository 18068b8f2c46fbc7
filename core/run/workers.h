// Work for several threads, without a queue: items are taken by one atomic index.
#pragma once

#include <cstddef>
#include <functional>

namespace hapticwall {

// `threads`; for 0 the number of processors that the calling thread may use, as set by taskset, a
// container or Slurm.
[[nodiscard]] std::size_t worker_count(int threads);

// Calls `work` for every item below `items` on at most `workers` threads, including the caller's,
// and returns after all calls. No two calls at a time have the same worker; each is below
// `workers`. The first exception ends the work and is rethrown. Where the system has
// no more threads, fewer do all of it. Realtime-safe: no.
void share_out(std::size_t items, std::size_t workers,
               const std::function<void(std::size_t item, std::size_t worker)>& work);

}  // namespace hapticwall
