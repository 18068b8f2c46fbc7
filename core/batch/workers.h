// A pile of work for several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace hapticwall::batch {

// `threads`, or as many as the processor runs at a time where that is 0.
[[nodiscard]] std::size_t worker_count(int threads);

// Calls `work` for every item below `items`, on at most `workers` threads, the caller's among them,
// and returns when all calls have. No two calls at a time have the same worker; each is below
// `workers`. What a call throws comes out, and no more items are begun. Realtime-safe: no.
void share_out(std::size_t items, std::size_t workers,
               const std::function<void(std::size_t item, std::size_t worker)>& work);

}  // namespace hapticwall::batch
